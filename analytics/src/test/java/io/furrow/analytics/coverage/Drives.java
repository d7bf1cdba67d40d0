package io.furrow.analytics.coverage;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.Random;

import io.furrow.analytics.Seeds;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.FieldRecords;
import io.furrow.analytics.position.PositionFix;

/**
 * Random drives of one to three robots over a field with a pond: curves, sharp turns, stops, gaps in time, a jump now and then, implements
 * that are switched off and on, and two missions.
 */
final class Drives {
    static final long START = 1_700_000_000_000L;
    /** Each report arrives at most so many ms after a newer one. */
    static final long BOUND = 2000;

    /** Meters from the middle of the field at which a robot turns back. */
    private static final double TURN = 35;

    private static final double SOUTH = 40.313;
    private static final double WEST = -3.484;
    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);
    private static final double METERS_PER_DEGREE_EAST = METERS_PER_DEGREE * Math.cos(Math.toRadians(SOUTH));

    final FieldRecords fields = new FieldRecords();
    final List<WorkReport> reports = new ArrayList<>();
    private final Random random;

    Drives(long seed) {
        random = Seeds.random(seed);
        fields.area(
                "f", 0, "farm", "[[" + border(30 + random.nextInt(30), 5 + random.nextInt(8)) + "," + pond() + "]]");
        int robots = 1 + random.nextInt(3);
        for (int robot = 0; robot < robots; robot++) {
            drive("r" + robot, 80 + random.nextInt(100));
        }
        reports.sort(WorkReport.SEQUENCE);
    }

    /** In an order in which none is late. */
    List<WorkReport> arrivals() {
        Map<WorkReport, Long> arrived = new HashMap<>();
        reports.forEach(report -> arrived.put(report, report.time() + random.nextInt((int) BOUND)));
        return reports.stream().sorted(Comparator.comparing(arrived::get)).toList();
    }

    static PositionFix fix(String robot, String mission, double east, double north, long time) {
        double latitude = SOUTH + north / METERS_PER_DEGREE;
        double longitude = WEST + east / METERS_PER_DEGREE_EAST;
        return new PositionFix(
                "data.raw",
                "farm|/|Robot|" + robot,
                robot,
                "Robot",
                mission,
                "",
                latitude,
                longitude,
                Double.NaN,
                Double.NaN,
                time);
    }

    /** The coordinates of a square field of this many meters, as of GeoJSON. */
    static String square(double meters) {
        return "[[[%s,%s,%s,%s,%s]]]"
                .formatted(corner(0, 0), corner(meters, 0), corner(meters, meters), corner(0, meters), corner(0, 0));
    }

    private void drive(String robot, int steps) {
        double east = random.nextInt(40) - 20;
        double north = random.nextInt(40) - 20;
        double heading = random.nextDouble() * 6;
        double width = 1 + random.nextInt(40) / 10.0;
        String mission = random.nextInt(3) == 0 ? "hoeing" : "weeding";
        Work work = random.nextBoolean() ? Work.UNKNOWN : Work.ON;
        long time = START + random.nextInt(5000);
        for (int step = 0; step < steps; step++) {
            boolean isSaid = step == 0 || random.nextInt(20) == 0;
            reports.add(new WorkReport(
                    fix(robot, mission, east, north, time), isSaid ? width : Double.NaN, isSaid ? work : Work.UNKNOWN));
            if (work != Work.UNKNOWN && random.nextInt(15) == 0) {
                work = work == Work.ON ? Work.OFF : Work.ON;
                reports.add(new WorkReport(fix(robot, mission, Double.NaN, Double.NaN, time), Double.NaN, work));
            }
            heading += random.nextInt(12) == 0 ? random.nextDouble() * 4 : random.nextGaussian() * 0.15;
            if (Math.hypot(east, north) > TURN) {
                heading = Math.atan2(-east, -north) + random.nextGaussian() * 0.5;
            }
            double speed = random.nextInt(25) == 0 ? 0 : 0.5 + random.nextDouble();
            double seconds = random.nextInt(25) == 0 ? 12 : 1;
            double way = random.nextInt(60) == 0 ? 30 : speed * seconds;
            east += way * Math.sin(heading);
            north += way * Math.cos(heading);
            time += (long) (seconds * 1000) - random.nextInt(100);
        }
    }

    private String border(double radius, int corners) {
        StringBuilder ring = new StringBuilder("[");
        String first = null;
        for (int i = 0; i < corners; i++) {
            double angle = 2 * Math.PI * i / corners;
            double r = radius * (0.6 + 0.4 * random.nextDouble());
            String corner = corner(r * Math.cos(angle), r * Math.sin(angle));
            first = first == null ? corner : first;
            ring.append(corner).append(',');
        }
        return ring.append(first).append(']').toString();
    }

    private static String pond() {
        return "[%s,%s,%s,%s]".formatted(corner(-4, -3), corner(4, -3), corner(0, 5), corner(-4, -3));
    }

    private static String corner(double east, double north) {
        return String.format(
                Locale.ROOT, "[%.9f,%.9f]", WEST + east / METERS_PER_DEGREE_EAST, SOUTH + north / METERS_PER_DEGREE);
    }
}
