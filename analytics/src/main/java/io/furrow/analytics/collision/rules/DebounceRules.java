package io.furrow.analytics.collision.rules;

import java.io.Serializable;
import java.time.Duration;

/**
 * The rules that keep encounters from flickering.
 *
 * @param leaveFactor an encounter lasts while the devices are within this many thresholds, 1 to 100
 * @param dwell an encounter counts when it lasts longer than this; zero for any
 */
public record DebounceRules(double leaveFactor, Duration dwell) implements Serializable {
    /** No debouncing: encounters exactly as defined. */
    public static final DebounceRules NONE = new DebounceRules(1, Duration.ZERO);

    private static final double GREATEST = 100;

    public DebounceRules {
        if (!(leaveFactor >= 1 && leaveFactor <= GREATEST)) {
            throw new IllegalArgumentException("the leave factor must be 1 to 100, not " + leaveFactor);
        }
        if (dwell.isNegative()) {
            throw new IllegalArgumentException("the dwell must not be negative: " + dwell);
        }
    }

    public boolean isNone() {
        return equals(NONE);
    }
}
