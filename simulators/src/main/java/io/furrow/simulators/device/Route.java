package io.furrow.simulators.device;

import java.util.List;

import io.furrow.model.ngsi.Position;

/**
 * Where a device stands or goes.
 *
 * @param where name of the place, reported as {@code Location}
 * @param points corners of the way in order; a single one for a device that stays
 * @param speed metres per second; 0 for a device that stays
 * @param start metres of the way that lie behind the device when it starts
 */
public record Route(String where, List<Position> points, double speed, double start) {
    public Route {
        if (points == null || points.isEmpty()) {
            throw new IllegalArgumentException("the route in " + where + " has no point: give at least one");
        }
        if (speed < 0 || start < 0) {
            throw new IllegalArgumentException("speed and start of the route in " + where + " must not be negative");
        }
        points = List.copyOf(points);
    }

    Path path() {
        return new Path(points, speed, start);
    }
}
