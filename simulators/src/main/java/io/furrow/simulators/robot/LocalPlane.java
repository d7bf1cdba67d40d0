package io.furrow.simulators.robot;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.ngsi.Position;

/**
 * Metres east (x) and north (y) of a place, on a sphere of radius 6,371 km whose meridians are parallel to that of the place:
 * a linear map, so that straight lines stay straight and what is inside stays inside. Lengths are below 0.1 % off within 5 km
 * up to latitude 60°.
 */
public record LocalPlane(Position origin) {
    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);

    /** Metres east and north. */
    public Coordinate toMeters(Position place) {
        return new Coordinate(
                (place.longitude() - origin.longitude()) * metersPerDegreeEast(),
                (place.latitude() - origin.latitude()) * METERS_PER_DEGREE);
    }

    /** The place so many metres east and north. */
    public Position toPosition(Coordinate meters) {
        return new Position(
                origin.latitude() + meters.y / METERS_PER_DEGREE,
                origin.longitude() + meters.x / metersPerDegreeEast());
    }

    private double metersPerDegreeEast() {
        return METERS_PER_DEGREE * Math.cos(Math.toRadians(origin.latitude()));
    }
}
