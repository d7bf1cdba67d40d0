package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;
import java.util.Comparator;
import java.util.Map;
import java.util.Optional;

import org.locationtech.jts.geom.Coordinate;

import io.furrow.model.position.Position;

/**
 * A robot on its way. Of two robots that come near each other the one with the smaller id continues; the other, if it has it ahead,
 * waits until it has passed, up to a maximum time, so that no two wait forever.
 *
 * @param encounterDistance meters within which it lets another robot pass; 0 to ignore others
 * @param maxWait maximum time of waiting for another
 */
public record RobotModel(String id, Trajectory way, double encounterDistance, Duration maxWait) {
    private static final double NANOS = 1e9;

    public RobotModel {
        if (!(encounterDistance >= 0) || maxWait.isNegative()) {
            throw new IllegalArgumentException("meeting distance and patience must not be negative: %s m, %s"
                    .formatted(encounterDistance, maxWait));
        }
    }

    public Trajectory.Pose pose(RobotState state) {
        return way.at(state.driven());
    }

    /** Current speed in meters per second: its pace, or 0. */
    public double speed(RobotState state) {
        return state.activity() == Activity.RUNNING && !pose(state).turning() ? way.speed() : 0;
    }

    /**
     * The state at a later time; a time that has passed changes nothing.
     *
     * @param others places of robots by id; may contain this one
     */
    public RobotState advance(RobotState state, Instant now, Map<String, Position> others) {
        Duration step = Duration.between(state.time(), now);
        if (step.isNegative() || step.isZero()) {
            return state;
        }
        if (state.activity() == Activity.STOPPED) {
            return new RobotState(now, state.driven(), Activity.STOPPED, Duration.ZERO, state.passing());
        }
        Optional<String> met = met(state, others);
        boolean passes = met.isPresent()
                && (met.get().equals(state.passing()) || state.waited().compareTo(maxWait) >= 0);
        if (met.isPresent() && !passes) {
            return new RobotState(
                    now, state.driven(), Activity.WAITING, state.waited().plus(step), null);
        }
        String passing = passes ? met.get() : stillNear(state, others);
        return new RobotState(now, state.driven() + step.toNanos() / NANOS, Activity.RUNNING, Duration.ZERO, passing);
    }

    /** The nearest robot within the meeting distance that has priority and is ahead. */
    private Optional<String> met(RobotState state, Map<String, Position> others) {
        Trajectory.Pose pose = pose(state);
        return others.keySet().stream()
                .filter(other -> other.compareTo(id) < 0)
                .filter(other -> distance(pose, others.get(other)) < encounterDistance)
                .filter(other -> ahead(pose, others.get(other)))
                .min(Comparator.comparingDouble((String other) -> distance(pose, others.get(other)))
                        .thenComparing(Comparator.naturalOrder()));
    }

    private String stillNear(RobotState state, Map<String, Position> others) {
        Position other = state.passing() == null ? null : others.get(state.passing());
        return other != null && distance(pose(state), other) < encounterDistance ? state.passing() : null;
    }

    private double distance(Trajectory.Pose pose, Position other) {
        return pose.meters().distance(way.plane().toMeters(other));
    }

    private boolean ahead(Trajectory.Pose pose, Position other) {
        Coordinate there = way.plane().toMeters(other);
        double heading = Math.toRadians(pose.heading());
        return (there.x - pose.meters().x) * Math.sin(heading) + (there.y - pose.meters().y) * Math.cos(heading) > 0;
    }
}
