package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.stream.Stream;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.ngsi.Position;

/**
 * A robot on its way. It stops before what lies on the way and goes on when that is gone. Of two robots that come near each
 * other that with the smaller id goes on; the other, if it has it before it, waits until it is gone, but not longer than its
 * patience, so that no two wait for ever.
 *
 * @param interruptions null where nothing turns up
 */
public record RobotModel(String id, Way way, Manners manners, Interruptions interruptions) {
    private static final double NANOS = 1e9;

    /**
     * How a robot treats what it meets.
     *
     * @param clearance metres that it keeps from an obstacle's edge
     * @param meeting metres within which it lets another robot pass; 0 to take no notice of others
     * @param patience how long it waits for another
     */
    public record Manners(double clearance, double meeting, Duration patience) {
        public Manners {
            if (!(clearance >= 0) || !(meeting >= 0) || patience.isNegative()) {
                throw new IllegalArgumentException(
                        "clearance, meeting distance and patience must not be negative: %s m, %s m, %s"
                                .formatted(clearance, meeting, patience));
            }
        }
    }

    /**
     * What is about.
     *
     * @param others where robots are, by id; may hold this one
     */
    public record Surroundings(List<Obstacle> obstacles, Map<String, Position> others) {
        public static final Surroundings NOTHING = new Surroundings(List.of(), Map.of());
    }

    public Way.Pose pose(RobotState state) {
        return way.at(state.driven());
    }

    /** Metres per second at this moment: its pace, or 0. */
    public double speed(RobotState state) {
        return state.activity() == Activity.RUNNING && !pose(state).turning() ? way.speed() : 0;
    }

    /** What it has become by a later time; a time that has passed changes nothing. */
    public RobotState advance(RobotState state, Instant now, Surroundings around) {
        Duration step = Duration.between(state.time(), now);
        if (step.isNegative() || step.isZero()) {
            return state;
        }
        if (state.activity() == Activity.STOPPED) {
            return new RobotState(now, state.driven(), Activity.STOPPED, Duration.ZERO, state.passing());
        }
        Optional<String> met = met(state, around.others());
        boolean passes = met.isPresent()
                && (met.get().equals(state.passing()) || state.waited().compareTo(manners.patience()) >= 0);
        if (met.isPresent() && !passes) {
            return new RobotState(
                    now, state.driven(), Activity.WAITING, state.waited().plus(step), null);
        }
        double seconds = step.toNanos() / NANOS;
        double free = free(state, now, seconds, around.obstacles());
        Activity activity = free < seconds ? Activity.BLOCKED : Activity.RUNNING;
        String passing = passes ? met.get() : stillNear(state, around.others());
        return new RobotState(now, state.driven() + free, activity, Duration.ZERO, passing);
    }

    /** The nearest robot that goes first, is near and before this one. */
    private Optional<String> met(RobotState state, Map<String, Position> others) {
        Way.Pose pose = pose(state);
        return others.keySet().stream()
                .filter(other -> other.compareTo(id) < 0)
                .filter(other -> distance(pose, others.get(other)) < manners.meeting())
                .filter(other -> ahead(pose, others.get(other)))
                .min(Comparator.comparingDouble((String other) -> distance(pose, others.get(other)))
                        .thenComparing(Comparator.naturalOrder()));
    }

    private String stillNear(RobotState state, Map<String, Position> others) {
        Position other = state.passing() == null ? null : others.get(state.passing());
        return other != null && distance(pose(state), other) < manners.meeting() ? state.passing() : null;
    }

    private double free(RobotState state, Instant now, double seconds, List<Obstacle> lasting) {
        Stream<Obstacle> chance =
                interruptions == null ? Stream.empty() : interruptions.between(way, state.time(), now).stream();
        return Stream.concat(lasting.stream(), chance)
                .filter(obstacle -> obstacle.during().meets(state.time(), now))
                .mapToDouble(obstacle -> way.secondsUntil(
                        state.driven(),
                        seconds,
                        way.plane().toMeters(obstacle.place()),
                        obstacle.radius() + manners.clearance()))
                .min()
                .orElse(seconds);
    }

    private double distance(Way.Pose pose, Position other) {
        return pose.meters().distance(way.plane().toMeters(other));
    }

    private boolean ahead(Way.Pose pose, Position other) {
        Coordinate there = way.plane().toMeters(other);
        double heading = Math.toRadians(pose.heading());
        return (there.x - pose.meters().x) * Math.sin(heading) + (there.y - pose.meters().y) * Math.cos(heading) > 0;
    }
}
