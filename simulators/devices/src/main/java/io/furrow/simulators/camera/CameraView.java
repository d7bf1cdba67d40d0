package io.furrow.simulators.camera;

import java.time.Instant;
import java.util.List;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.position.Position;
import io.furrow.simulators.robot.LocalPlane;

/**
 * The surroundings of a camera.
 *
 * @param heading direction of the camera, degrees clockwise from north
 * @param robots places of robots, in sight or not
 */
public record CameraView(Instant time, Position place, double heading, List<Position> robots) {
    /** Degrees to each side of the middle of the picture. */
    static final double HALF_ANGLE = 35;
    /** Meters. */
    static final double SIGHT = 60;

    /**
     * A robot in the picture.
     *
     * @param aside -1 at the left edge of the picture to 1 at its right edge
     * @param meters distance
     */
    record VisibleRobot(double aside, double meters) {}

    /** The robots in the picture, the farthest first. */
    List<VisibleRobot> visibleRobots() {
        return robots.stream()
                .map(this::visible)
                .filter(seen -> Math.abs(seen.aside) <= 1 && seen.meters <= SIGHT && seen.meters > 0)
                .sorted((a, b) -> Double.compare(b.meters, a.meters))
                .toList();
    }

    private VisibleRobot visible(Position robot) {
        Coordinate meters = new LocalPlane(place).toMeters(robot);
        double bearing = Math.toDegrees(Math.atan2(meters.x, meters.y));
        double off = Math.floorMod(Math.round((bearing - heading + 180) * 1000), 360_000L) / 1000d - 180;
        return new VisibleRobot(off / HALF_ANGLE, Math.hypot(meters.x, meters.y));
    }
}
