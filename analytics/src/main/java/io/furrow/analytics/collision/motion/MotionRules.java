package io.furrow.analytics.collision.motion;

import java.io.Serializable;
import java.time.Duration;
import java.util.Set;

import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * The rules of predictions and crossings.
 *
 * @param common thresholds, time-to-live, zones, rate of records and cell, as for encounters
 * @param horizon how far ahead of a position its course is extrapolated; zero for no predictions
 * @param crossed whether motions between two positions are compared
 * @param maxSpeed meters per second; a faster motion is attributed to a faulty position
 * @param movingTypes entity types that take part; empty for all
 */
public record MotionRules(
        CollisionRules common, Duration horizon, boolean crossed, double maxSpeed, Set<String> movingTypes)
        implements Serializable {
    /** Beyond it the curvature of the Earth matters: the end of such a segment would be 8 m above the ground. */
    private static final double MAX_WAY_METERS = 10_000;

    /** The maximum number of cubes, approximately, that the fastest machine's segment ahead crosses. */
    private static final double CUBES_AHEAD = 4;

    public MotionRules {
        movingTypes = Set.copyOf(movingTypes);
        require(!horizon.isNegative(), "the horizon must not be negative: " + horizon);
        require(maxSpeed > 0 && Double.isFinite(maxSpeed), "the greatest speed must be above 0 m/s, not " + maxSpeed);
        require(
                wayAhead(maxSpeed, horizon) <= MAX_WAY_METERS,
                "the horizon of " + horizon.toMillis() / 1000.0 + " s at the greatest speed of " + maxSpeed
                        + " m/s leads more than " + MAX_WAY_METERS + " m ahead; make one of them less");
    }

    /** Whether predictions or crossings are enabled. */
    public boolean any() {
        return crossed || predicts();
    }

    boolean predicts() {
        return !horizon.isZero();
    }

    boolean moves(String type) {
        return movingTypes.isEmpty() || movingTypes.contains(type);
    }

    long timeToLive() {
        return common.positions().timeToLive().toMillis();
    }

    double cubeMeters() {
        return Math.max(common.cells().meters(), wayAhead(maxSpeed, horizon) / CUBES_AHEAD);
    }

    private static double wayAhead(double speed, Duration horizon) {
        return speed * horizon.toMillis() / 1000;
    }

    private static void require(boolean met, String otherwise) {
        if (!met) {
            throw new IllegalArgumentException(otherwise);
        }
    }
}
