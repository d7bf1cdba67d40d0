package io.furrow.analytics.collision.rules;

import java.io.Serializable;
import java.time.Duration;

/**
 * The rules by which positions are valid.
 *
 * @param timeToLive how long a position is valid if no newer one arrives, at least 1 ms
 * @param maxSkew how far apart in time the positions of a close pair may be; zero for any
 * @param zones where no position counts
 */
public record PositionRules(Duration timeToLive, Duration maxSkew, ExclusionZones zones) implements Serializable {
    public PositionRules {
        if (timeToLive.toMillis() < 1) {
            throw new IllegalArgumentException("the time-to-live must be at least 1 ms, not " + timeToLive);
        }
        if (maxSkew.isNegative()) {
            throw new IllegalArgumentException("the greatest skew must not be negative: " + maxSkew);
        }
    }
}
