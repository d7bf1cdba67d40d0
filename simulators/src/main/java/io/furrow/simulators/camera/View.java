package io.furrow.simulators.camera;

import java.time.Instant;
import java.util.List;

import io.furrow.model.ngsi.Position;

/**
 * What is before a camera.
 *
 * @param heading where it looks, degrees clockwise from north
 * @param where name of the place, may be empty
 * @param about what is near, in sight or not
 */
public record View(String camera, Instant time, Position place, double heading, String where, List<Thing> about) {
    /** Degrees to each side of the middle of the picture. */
    static final double HALF_ANGLE = 35;
    /** Metres. */
    static final double SIGHT = 60;

    private static final double METERS_PER_DEGREE = Math.toRadians(6_371_000);

    /** Something that can be seen. */
    public record Thing(String name, Position place) {}

    /**
     * A thing in the picture.
     *
     * @param aside -1 at its left edge to 1 at its right edge
     * @param meters how far away
     */
    record Sighting(String name, double aside, double meters) {}

    /** What is in the picture, the farthest first. */
    List<Sighting> sightings() {
        return about.stream()
                .map(this::sighting)
                .filter(seen -> Math.abs(seen.aside) <= 1 && seen.meters <= SIGHT && seen.meters > 0)
                .sorted((a, b) -> Double.compare(b.meters, a.meters))
                .toList();
    }

    private Sighting sighting(Thing thing) {
        double north = (thing.place.latitude() - place.latitude()) * METERS_PER_DEGREE;
        double east = (thing.place.longitude() - place.longitude())
                * METERS_PER_DEGREE
                * Math.cos(Math.toRadians(place.latitude()));
        double bearing = Math.toDegrees(Math.atan2(east, north));
        double off = Math.floorMod(Math.round((bearing - heading + 180) * 1000), 360_000L) / 1000d - 180;
        return new Sighting(thing.name, off / HALF_ANGLE, Math.hypot(north, east));
    }
}
