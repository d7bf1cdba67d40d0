package io.furrow.connect.broker;

import java.time.Duration;
import java.util.Optional;

import io.furrow.model.time.Backoff;

/** How long to leave a context broker alone: twice as long after each failure, and at least as long as it asks for. */
public final class BrokerBackoff {
    /** What a broker asks for is not followed blindly: a wrong date would stop everything for years. */
    private static final Duration MAX_ASKED = Duration.ofHours(1);

    private final Backoff backoff;

    public BrokerBackoff(Duration min, Duration max) {
        backoff = new Backoff(min, max);
    }

    /** @param retryAfter what the broker asks for; empty if it names no time */
    public Duration after(Optional<Duration> retryAfter) {
        Duration delay = backoff.next();
        Duration asked = retryAfter.orElse(Duration.ZERO);
        Duration heeded = asked.compareTo(MAX_ASKED) < 0 ? asked : MAX_ASKED;
        return heeded.compareTo(delay) > 0 ? heeded : delay;
    }

    /** It answered. */
    public void reset() {
        backoff.reset();
    }
}
