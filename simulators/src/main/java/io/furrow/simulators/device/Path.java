package io.furrow.simulators.device;

import java.time.Duration;
import java.util.List;

import io.furrow.model.ngsi.Position;

/**
 * The place of a device that goes along a line of points at constant speed, turns round at each end and comes back.
 * Lengths are metres on a sphere of radius 6,371 km, plane within one stretch: below 1 cm off for ways of a farm's size.
 */
final class Path {
    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);

    private final List<Position> points;
    private final double speed;
    private final double start;
    private final double[] lengths;
    private final double total;

    /**
     * @param speed metres per second
     * @param start metres along the way at time zero
     */
    Path(List<Position> points, double speed, double start) {
        this.points = points;
        this.speed = speed;
        this.start = start;
        this.lengths = new double[points.size() - 1];
        double sum = 0;
        for (int i = 0; i < lengths.length; i++) {
            lengths[i] = meters(points.get(i), points.get(i + 1));
            sum += lengths[i];
        }
        this.total = sum;
    }

    /** The place after the given time under way. */
    Position at(Duration underWay) {
        if (total == 0) {
            return points.get(0);
        }
        double gone = (start + speed * underWay.toNanos() / 1e9) % (2 * total);
        double left = gone <= total ? gone : 2 * total - gone;
        for (int i = 0; i < lengths.length; i++) {
            if (left <= lengths[i]) {
                return between(points.get(i), points.get(i + 1), lengths[i] == 0 ? 0 : left / lengths[i]);
            }
            left -= lengths[i];
        }
        return points.get(points.size() - 1);
    }

    /** The distance of two places that are near each other. */
    static double meters(Position a, Position b) {
        double north = (b.latitude() - a.latitude()) * METERS_PER_DEGREE;
        double middle = Math.toRadians((a.latitude() + b.latitude()) / 2);
        double east = (b.longitude() - a.longitude()) * METERS_PER_DEGREE * Math.cos(middle);
        return Math.hypot(north, east);
    }

    private static Position between(Position a, Position b, double share) {
        return new Position(
                a.latitude() + share * (b.latitude() - a.latitude()),
                a.longitude() + share * (b.longitude() - a.longitude()));
    }
}
