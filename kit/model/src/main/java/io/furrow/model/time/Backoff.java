package io.furrow.model.time;

import java.time.Duration;

/** Computes delays between attempts that double from {@code min} to {@code max}. Not thread-safe. */
public final class Backoff {
    private final Duration min;
    private final Duration max;
    private Duration next;

    /**
     * @throws IllegalArgumentException if {@code min} is not positive or greater than {@code max}
     */
    public Backoff(Duration min, Duration max) {
        if (min.isNegative() || min.isZero() || min.compareTo(max) > 0) {
            throw new IllegalArgumentException(
                    "a backoff is from a positive time to one at least as long, not from %s to %s".formatted(min, max));
        }
        this.min = min;
        this.max = max;
        this.next = min;
    }

    /** Returns the delay before the next attempt. */
    public Duration next() {
        Duration delay = next;
        next = delay.compareTo(max.minus(delay)) > 0 ? max : delay.multipliedBy(2);
        return delay;
    }

    /** Restarts with {@code min} after a success. */
    public void reset() {
        next = min;
    }
}
