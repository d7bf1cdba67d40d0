package io.furrow.analytics.presence;

import java.io.Serializable;
import java.time.Duration;

/**
 * The rules by which a device counts as inside a field.
 *
 * @param timeToLive how long a position is valid if no newer one arrives
 * @param dwell how long a device must be in before it has entered, and out before it has left
 */
public record PresenceRules(Duration timeToLive, Duration dwell) implements Serializable {
    public PresenceRules {
        if (timeToLive.isZero() || timeToLive.isNegative()) {
            throw new IllegalArgumentException("--time-to-live must be longer than 0, for instance 5min");
        }
        if (dwell.isNegative()) {
            throw new IllegalArgumentException("--dwell must not be negative");
        }
    }
}
