package io.furrow.simulators.robot;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.position.Position;

/**
 * Projects places to meters east (x) and north (y) of an origin, linearly, on a sphere of radius 6,371 km. Lengths are
 * off by less than 0.1 % within 5 km up to latitude 60°.
 */
public record LocalPlane(Position origin) {
    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);

    /** Meters east and north. */
    public Coordinate toMeters(Position place) {
        return new Coordinate(
                (place.longitude() - origin.longitude()) * metersPerDegreeEast(),
                (place.latitude() - origin.latitude()) * METERS_PER_DEGREE);
    }

    /** The place at a distance in meters east and north. */
    public Position toPosition(Coordinate meters) {
        return new Position(
                origin.latitude() + meters.y / METERS_PER_DEGREE,
                origin.longitude() + meters.x / metersPerDegreeEast());
    }

    private double metersPerDegreeEast() {
        return METERS_PER_DEGREE * Math.cos(Math.toRadians(origin.latitude()));
    }
}
