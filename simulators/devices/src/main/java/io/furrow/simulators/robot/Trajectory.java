package io.furrow.simulators.robot;

import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;
import org.locationtech.jts.geom.LineSegment;

import io.furrow.model.position.Position;

/**
 * A way and its timing: straight on at constant speed, a turn on the spot at each corner; at its end the robot turns
 * and comes back, forever. Times are seconds of driving since the start of the way.
 */
public final class Trajectory {
    private static final double SAME_PLACE = 1e-6;

    private final LocalPlane plane;
    private final double speed;
    /** There and back; the last is the first. */
    private final Coordinate[] points;
    /** Degrees clockwise from north of each stretch between two points. */
    private final double[] headings;
    /** Times at which the robot leaves each point, turned towards the next. */
    private final double[] leaves;

    private final double lap;

    /** Position and heading of a robot, the latter in degrees clockwise from north, 0 to below 360. */
    public record Pose(Coordinate meters, Position place, double heading, boolean turning) {}

    private Trajectory(LocalPlane plane, List<Coordinate> there, Pace pace) {
        this.plane = plane;
        this.speed = pace.speed();
        List<Coordinate> all = new ArrayList<>();
        there.forEach(place -> addNew(all, place));
        for (int back = all.size() - 2; back >= 0; back--) {
            all.add(all.get(back));
        }
        this.points = all.toArray(Coordinate[]::new);
        int stretches = points.length - 1;
        this.headings = new double[stretches];
        this.leaves = new double[stretches];
        double time = 0;
        for (int i = 0; i < stretches; i++) {
            headings[i] = heading(points[i], points[i + 1]);
            time += i == 0 ? 0 : Math.abs(turn(headings[i - 1], headings[i])) / pace.turnRate();
            leaves[i] = time;
            time += points[i].distance(points[i + 1]) / speed;
        }
        // The last turn leads into the first stretch of the next lap.
        this.lap = stretches == 0 ? 0 : time + Math.abs(turn(headings[stretches - 1], headings[0])) / pace.turnRate();
    }

    /**
     * The speed of a robot.
     *
     * @param speed meters per second, above 0
     * @param turnRate degrees per second, above 0; may be infinite
     */
    public record Pace(double speed, double turnRate) {
        public Pace {
            if (!(speed > 0) || Double.isInfinite(speed) || !(turnRate > 0)) {
                throw new IllegalArgumentException(
                        "speed and turn rate must be above 0, not %s m/s and %s degrees/s".formatted(speed, turnRate));
            }
        }
    }

    /** Along a line of places. */
    public static Trajectory along(List<Position> places, Pace pace) {
        LocalPlane plane = new LocalPlane(places.get(0));
        return new Trajectory(plane, places.stream().map(plane::toMeters).toList(), pace);
    }

    /**
     * Row by row through a field, straight from the end of a row to the start of the next.
     *
     * @throws IllegalArgumentException if the field has no room for rows
     */
    public static Trajectory through(WorkField field, Work work, Pace pace) {
        List<Coordinate> way = new ArrayList<>();
        for (LineSegment row : Rows.of(field, work.spacing(), work.margin(), work.bearing())) {
            way.add(row.p0);
            way.add(row.p1);
        }
        return new Trajectory(field.plane(), way, pace);
    }

    /**
     * The pattern of work in a field.
     *
     * @param spacing meters from row to row
     * @param margin minimum distance of rows from the field's edge, meters
     * @param bearing direction of the rows, degrees clockwise from north; null for that of the field's longer side
     */
    public record Work(double spacing, double margin, Double bearing) {
        private static final double FINEST = 0.1;

        public Work {
            if (!(spacing >= FINEST) || !(margin >= FINEST)) {
                throw new IllegalArgumentException(
                        "spacing and margin must be at least %s m, not %s and %s".formatted(FINEST, spacing, margin));
            }
        }
    }

    public LocalPlane plane() {
        return plane;
    }

    public double speed() {
        return speed;
    }

    /** Seconds of a round trip; 0 for a single place. */
    public double lap() {
        return lap;
    }

    /** The pose of a robot after this many seconds of driving. */
    public Pose at(double seconds) {
        if (lap == 0) {
            return new Pose(points[0], plane.toPosition(points[0]), 0, false);
        }
        double time = seconds % lap;
        int stretch = stretchAt(time);
        double driven = (time - leaves[stretch]) * speed;
        double length = points[stretch].distance(points[stretch + 1]);
        if (driven <= length) {
            Coordinate here = between(points[stretch], points[stretch + 1], driven / length);
            return new Pose(here, plane.toPosition(here), headings[stretch], false);
        }
        return turningAfter(stretch, time - leaves[stretch] - length / speed);
    }

    private Pose turningAfter(int stretch, double seconds) {
        int next = (stretch + 1) % headings.length;
        double all = turn(headings[stretch], headings[next]);
        double due = (stretch + 1 < leaves.length ? leaves[stretch + 1] : lap)
                - leaves[stretch]
                - points[stretch].distance(points[stretch + 1]) / speed;
        double heading = headings[stretch] + (due > 0 ? all * Math.min(1, seconds / due) : all);
        Coordinate corner = points[stretch + 1];
        return new Pose(corner, plane.toPosition(corner), positive(heading), true);
    }

    private int stretchAt(double time) {
        int found = Arrays.binarySearch(leaves, time);
        return found >= 0 ? found : Math.max(0, -found - 2);
    }

    private static void addNew(List<Coordinate> all, Coordinate place) {
        if (all.isEmpty() || all.get(all.size() - 1).distance(place) > SAME_PLACE) {
            all.add(place);
        }
    }

    private static Coordinate between(Coordinate from, Coordinate to, double share) {
        double part = Math.min(1, Math.max(0, share));
        return new Coordinate(from.x + part * (to.x - from.x), from.y + part * (to.y - from.y));
    }

    private static double heading(Coordinate from, Coordinate to) {
        return positive(Math.toDegrees(Math.atan2(to.x - from.x, to.y - from.y)));
    }

    private static double positive(double degrees) {
        return ((degrees % 360) + 360) % 360;
    }

    /** The shorter way round, -180 to 180. */
    private static double turn(double from, double to) {
        double by = positive(to - from);
        return by > 180 ? by - 360 : by;
    }
}
