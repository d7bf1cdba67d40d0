package io.furrow.analytics.collision.motion;

import java.io.Serializable;
import java.time.Duration;
import java.util.Set;

import io.furrow.analytics.collision.rules.CollisionRules;

/**
 * What counts as predicted and as crossed.
 *
 * @param common thresholds, time-to-live, zones, the rate of records and the cell: as for encounters
 * @param horizon how far ahead of a position its course is followed; zero for no predictions
 * @param crossed whether the ways between two positions are compared
 * @param maxSpeed meters per second; what seems faster is a faulty position and no way
 * @param movingTypes entity types that are looked at; empty for all
 */
public record MotionRules(
        CollisionRules common, Duration horizon, boolean crossed, double maxSpeed, Set<String> movingTypes)
        implements Serializable {
    /** Beyond it the Earth is too round for a straight line: the end of such a segment would be 8 m above the ground. */
    private static final double MAX_WAY_METERS = 10_000;

    /** Into how many cubes at most the fastest machine's way ahead leads, about. */
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

    /** Whether there is anything to find. */
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
