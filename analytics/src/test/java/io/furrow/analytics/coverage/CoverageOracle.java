package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.IntBinaryOperator;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.CoordinateSequence;
import org.locationtech.jts.geom.Geometry;
import org.locationtech.jts.geom.GeometryFactory;
import org.locationtech.jts.geom.prep.PreparedGeometry;
import org.locationtech.jts.geom.prep.PreparedGeometryFactory;
import org.locationtech.jts.geom.util.GeometryTransformer;
import org.locationtech.jts.operation.overlayng.OverlayNG;
import org.locationtech.jts.operation.overlayng.OverlayNGRobust;

import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.position.PositionFix;

/** The definition of coverage with exact polygons, swath by swath and cell by cell; without event time, tiles or state. */
final class CoverageOracle {
    private static final GeometryFactory GEOMETRIES = new GeometryFactory();

    private final Geometry area;
    private final FieldGrid grid;
    private final CoverageRules rules;

    /**
     * A swath as exact polygon.
     *
     * @param isContinued whether it begins where the one before it in the list of its robot ended
     * @param from meters driven
     */
    record Exact(
            String robot,
            String mission,
            Geometry shape,
            long begin,
            long time,
            boolean isContinued,
            double from,
            double length,
            double width) {}

    /** @param area in degrees */
    CoverageOracle(Geometry area, CoverageRules rules) {
        this.grid = FieldGrid.of(area, rules.cell());
        this.area = inMeters(area, grid);
        this.rules = rules;
    }

    FieldGrid grid() {
        return grid;
    }

    /** The field in the meters of the grid. */
    Geometry area() {
        return area;
    }

    static Geometry inMeters(Geometry degrees, FieldGrid grid) {
        return new GeometryTransformer() {
            @Override
            protected CoordinateSequence transformCoordinates(CoordinateSequence points, Geometry parent) {
                Coordinate[] meters = new Coordinate[points.size()];
                for (int i = 0; i < meters.length; i++) {
                    meters[i] = grid.toMeters(points.getX(i), points.getY(i));
                }
                return factory.getCoordinateSequenceFactory().create(meters);
            }
        }.transform(degrees);
    }

    /** All swaths in the field, by robot, each robot's in order. */
    List<Exact> swaths(List<WorkReport> reports) {
        Map<String, List<WorkReport>> byRobot = new TreeMap<>();
        reports.forEach(report -> byRobot.computeIfAbsent(report.fix().id(), none -> new ArrayList<>())
                .add(report));
        List<Exact> swaths = new ArrayList<>();
        byRobot.values().forEach(own -> swaths(own, swaths));
        return swaths;
    }

    private void swaths(List<WorkReport> own, List<Exact> swaths) {
        double width = rules.width();
        Work work = Work.UNKNOWN;
        WorkReport last = null;
        boolean lastWorks = false;
        double lastWidth = width;
        Exact before = null;
        PositionFix prior = null;
        for (WorkReport report : own) {
            width = Double.isNaN(report.width()) ? width : report.width();
            work = report.work() == Work.UNKNOWN ? work : report.work();
            if (!report.isLocated()) {
                continue;
            }
            Exact swath = last == null || !lastWorks || Double.isNaN(lastWidth)
                    ? null
                    : swath(last, report, lastWidth, before, prior);
            if (swath != null) {
                swaths.add(swath);
                prior = last.fix();
            }
            before = swath;
            last = report;
            lastWorks = work != Work.OFF;
            lastWidth = width;
        }
    }

    private Exact swath(WorkReport from, WorkReport to, double width, Exact before, PositionFix prior) {
        Coordinate a = meters(from.fix());
        Coordinate b = meters(to.fix());
        double seconds = (to.time() - from.time()) / 1000.0;
        double length = a.distance(b);
        boolean isWork = seconds <= rules.maxGap().toMillis() / 1000.0
                && length / seconds >= rules.minSpeed()
                && length / seconds <= rules.maxSpeed();
        if (!isWork || !covers(a) && !covers(b)) {
            return null;
        }
        List<Geometry> parts = new ArrayList<>(
                List.of(hull(left(a, b, width, a), left(a, b, width, b), left(b, a, width, a), left(b, a, width, b))));
        if (before != null) {
            Coordinate z = meters(prior);
            parts.add(hull(a, left(z, a, width, a), left(a, b, width, a)));
            parts.add(hull(a, left(a, z, width, a), left(b, a, width, a)));
        }
        return new Exact(
                to.fix().id(),
                to.fix().mission(),
                OverlayNGRobust.union(parts),
                from.time(),
                to.time(),
                before != null,
                before == null ? 0 : before.from + before.length,
                length,
                width);
    }

    /** Half the width to the left of a place on the way from a to b. */
    private static Coordinate left(Coordinate a, Coordinate b, double width, Coordinate place) {
        double angle = Math.atan2(b.y - a.y, b.x - a.x) + Math.PI / 2;
        return new Coordinate(place.x + width / 2 * Math.cos(angle), place.y + width / 2 * Math.sin(angle));
    }

    private static Geometry hull(Coordinate... corners) {
        return GEOMETRIES.createMultiPointFromCoords(corners).convexHull();
    }

    private Coordinate meters(PositionFix fix) {
        return grid.toMeters(fix.longitude(), fix.latitude());
    }

    private boolean covers(Coordinate place) {
        return area.covers(GEOMETRIES.createPoint(place));
    }

    /** What is covered of the field. */
    Geometry union(List<Exact> swaths) {
        Geometry union = OverlayNGRobust.union(swaths.stream().map(Exact::shape).toList(), GEOMETRIES);
        return OverlayNGRobust.overlay(union, area, OverlayNG.INTERSECTION);
    }

    Geometry center(int row, int column) {
        return GEOMETRIES.createPoint(new Coordinate((column + 0.5) * grid.cell(), (row + 0.5) * grid.cell()));
    }

    /**
     * The codes of all cells, row by row, 0 also outside of the field.
     *
     * @param swaths a robot's in order
     */
    int[][] codes(List<Exact> swaths) {
        int[][] codes = new int[grid.rows()][grid.columns()];
        Map<Exact, PreparedGeometry> prepared = new HashMap<>();
        swaths.forEach(swath -> prepared.put(swath, PreparedGeometryFactory.prepare(swath.shape())));
        for (int row = 0; row < grid.rows(); row++) {
            for (int column = 0; column < grid.columns(); column++) {
                Geometry center = center(row, column);
                if (grid.isInside(row, column)) {
                    List<Integer> covering = new ArrayList<>();
                    for (int i = 0; i < swaths.size(); i++) {
                        if (prepared.get(swaths.get(i)).covers(center)) {
                            covering.add(i);
                        }
                    }
                    codes[row][column] = covering.isEmpty() ? 0 : isOverlap(covering, swaths) ? 2 : 1;
                }
            }
        }
        double width = swaths.stream().mapToDouble(Exact::width).max().orElse(0);
        markGaps(codes, (int) Math.ceil(2 * width / grid.cell()));
        return codes;
    }

    private static boolean isOverlap(List<Integer> covering, List<Exact> swaths) {
        for (int later : covering) {
            for (int earlier : covering) {
                boolean isSame =
                        swaths.get(later).robot().equals(swaths.get(earlier).robot());
                if (!isSame || earlier < later && !isOneWay(earlier, later, swaths)) {
                    return true;
                }
            }
        }
        return false;
    }

    /** Whether the robot drove on without interruption, at most the working width in between. */
    private static boolean isOneWay(int earlier, int later, List<Exact> swaths) {
        for (int i = earlier + 1; i <= later; i++) {
            if (!swaths.get(i).isContinued()) {
                return false;
            }
        }
        Exact first = swaths.get(earlier);
        return swaths.get(later).from() - first.from() - first.length()
                <= swaths.get(later).width();
    }

    private void markGaps(int[][] codes, int most) {
        IntBinaryOperator covered = (row, column) ->
                row < 0 || column < 0 || row >= grid.rows() || column >= grid.columns() || codes[row][column] % 3 == 0
                        ? 0
                        : 1;
        for (int row = 0; row < grid.rows(); row++) {
            for (int column = 0; column < grid.columns(); column++) {
                boolean isGap = grid.isInside(row, column)
                        && codes[row][column] == 0
                        && (isBetween(row, column, 0, 1, most, covered) || isBetween(row, column, 1, 0, most, covered));
                codes[row][column] = isGap ? 3 : codes[row][column];
            }
        }
    }

    private static boolean isBetween(int row, int column, int up, int right, int most, IntBinaryOperator covered) {
        int before = 1;
        while (before <= most && covered.applyAsInt(row - before * up, column - before * right) == 0) {
            before++;
        }
        int after = 1;
        while (after <= most && covered.applyAsInt(row + after * up, column + after * right) == 0) {
            after++;
        }
        return before <= most && after <= most && before + after - 1 <= most;
    }
}
