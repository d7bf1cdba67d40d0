package io.furrow.analytics.coverage;

import java.util.Comparator;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.analytics.eventtime.HasEventTime;
import io.furrow.analytics.position.PositionFix;

/**
 * What an implement covers between two positions of its robot: the rectangle around the line between them. If the robot continues an
 * earlier swath in the same field, also the two triangles between the ends of both rectangles.
 *
 * @param field whose cells are covered
 * @param area of the field as WKB; null if the swath continues an earlier one, with which it was sent
 * @param priorLatitude where the earlier swath began, degrees; NaN if this one does not continue any
 * @param priorLongitude likewise
 * @param driven meters along continued swaths up to {@code from}
 * @param width working width, meters
 * @param ofRobot whether it counts for the robot alone; otherwise for all robots of the mission
 */
public record Swath(
        PositionFix from,
        PositionFix to,
        FieldRef field,
        byte[] area,
        double priorLatitude,
        double priorLongitude,
        double driven,
        double width,
        boolean ofRobot)
        implements HasEventTime {
    /** A grid projects at the middle of its field, {@link #distance} at that of both positions. */
    private static final double TOLERANCE = 1.01;

    /** By time, then by robot. */
    static final Comparator<Swath> SEQUENCE =
            Comparator.comparingLong(Swath::time).thenComparing(Swath::robot);

    @Override
    public long time() {
        return to.time();
    }

    /** Tenant, service path, type and id of the robot. */
    String robot() {
        return to.identity();
    }

    boolean isOfSameRobot(Swath other) {
        return robot().equals(other.robot());
    }

    /** Whether an earlier swath of the same robot ended at most a working width before this one on the same way. */
    boolean isJustAfter(Swath earlier) {
        return isContinued() && driven - earlier.driven - earlier.length() <= width;
    }

    /** Meters from end to end. */
    double length() {
        return distance(from, to);
    }

    /** Meters between two positions near each other. */
    static double distance(PositionFix a, PositionFix b) {
        double latitude = Math.toRadians(a.latitude() + b.latitude()) / 2;
        double east = Math.toRadians(b.longitude() - a.longitude()) * StrictMath.cos(latitude);
        double north = Math.toRadians(b.latitude() - a.latitude());
        return FieldGrid.EARTH_RADIUS * Math.sqrt(east * east + north * north);
    }

    /** Whether the outlines of both may meet; false only if their ends are further apart than both are long and wide. */
    boolean isNear(Swath other) {
        double most = length() + other.length() + (width + other.width) / 2;
        return distance(to, other.to) <= TOLERANCE * most;
    }

    boolean isContinued() {
        return !Double.isNaN(priorLatitude);
    }

    /** The same for the robot alone. */
    Swath forRobot() {
        return new Swath(from, to, field, area, priorLatitude, priorLongitude, driven, width, true);
    }

    /** The same without the area. */
    Swath withoutArea() {
        return new Swath(from, to, field, null, priorLatitude, priorLongitude, driven, width, ofRobot);
    }

    /** The coverage that it belongs to: a mission's, in a version of a field, of one robot or of all. */
    public String key() {
        return to.topic() + '|' + field.validFrom() + '|' + name();
    }

    /** The same without topic and version. */
    String name() {
        String mission = to.scope().identity(to.mission().length() + ":" + to.mission());
        return mission + '|' + field.id() + '|' + (ofRobot ? robot() : "");
    }

    /** The convex parts of its outline in the meters of a grid. */
    Coordinate[][] outline(FieldGrid grid) {
        Coordinate a = grid.toMeters(from.longitude(), from.latitude());
        Coordinate b = grid.toMeters(to.longitude(), to.latitude());
        Coordinate side = side(a, b);
        Coordinate[] rectangle = {plus(a, side), plus(b, side), minus(b, side), minus(a, side)};
        if (!isContinued()) {
            return new Coordinate[][] {rectangle};
        }
        Coordinate before = side(grid.toMeters(priorLongitude, priorLatitude), a);
        return new Coordinate[][] {rectangle, {a, plus(a, before), plus(a, side)}, {a, minus(a, before), minus(a, side)}
        };
    }

    /** Half the width to the left of the way from a to b. */
    private Coordinate side(Coordinate a, Coordinate b) {
        double factor = width / 2 / a.distance(b);
        return new Coordinate((a.y - b.y) * factor, (b.x - a.x) * factor);
    }

    private static Coordinate plus(Coordinate a, Coordinate b) {
        return new Coordinate(a.x + b.x, a.y + b.y);
    }

    private static Coordinate minus(Coordinate a, Coordinate b) {
        return new Coordinate(a.x - b.x, a.y - b.y);
    }
}
