package io.furrow.analytics.collision;

import java.io.Serializable;
import java.time.Duration;

/**
 * What counts as an encounter, and how it is reported.
 *
 * @param thresholdMeters up to which distance two devices are close, 0.1 to 100,000
 * @param timeToLive how long a position counts when no newer one comes, at least 1 ms
 * @param maxSkew how far apart in time the positions of a close pair may be; zero for any
 * @param ongoingEvery least event time between two records of a lasting encounter; zero reports every sighting
 * @param cellMeters height of a grid cell, at least the threshold; no result depends on it, only speed
 */
public record CollisionRules(
        double thresholdMeters, Duration timeToLive, Duration maxSkew, Duration ongoingEvery, double cellMeters)
        implements Serializable {
    /** 5 m, 30 s, any skew, a record a second, cells of 20 thresholds: about 1.1 copies of each position. */
    public static final CollisionRules DEFAULT =
            new CollisionRules(5, Duration.ofSeconds(30), Duration.ZERO, Duration.ofSeconds(1), 100);

    /** Below this the rounding of unit vectors would leave the guard band of {@link Proximity}. */
    private static final double LEAST_THRESHOLD = 0.1;

    private static final double GREATEST_THRESHOLD = 100_000;

    public CollisionRules {
        require(
                thresholdMeters >= LEAST_THRESHOLD && thresholdMeters <= GREATEST_THRESHOLD,
                "the threshold must be 0.1 to 100000 metres, not " + thresholdMeters);
        require(timeToLive.toMillis() > 0, "the time-to-live must be at least 1 ms, not " + timeToLive);
        require(!maxSkew.isNegative(), "the greatest skew must not be negative: " + maxSkew);
        require(!ongoingEvery.isNegative(), "the time between ongoing records must not be negative: " + ongoingEvery);
        require(
                cellMeters >= thresholdMeters && Double.isFinite(cellMeters),
                "the cell must be at least as high as the threshold, not " + cellMeters + " metres");
    }

    private static void require(boolean met, String otherwise) {
        if (!met) {
            throw new IllegalArgumentException(otherwise);
        }
    }
}
