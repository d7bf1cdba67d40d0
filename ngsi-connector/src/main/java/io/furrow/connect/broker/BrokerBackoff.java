package io.furrow.connect.broker;

import java.time.Duration;
import java.util.Optional;

import io.furrow.model.time.Backoff;

/**
 * Computes the pause before the next request to a failing context broker: doubles after each failure, and is at least
 * as long as the broker requests.
 */
public final class BrokerBackoff {
    /** Limits the requested pause: a wrong date would stop everything for years. */
    private static final Duration MAX_ASKED = Duration.ofHours(1);

    private final Backoff backoff;

    public BrokerBackoff(Duration min, Duration max) {
        backoff = new Backoff(min, max);
    }

    /** @param retryAfter the pause that the broker requests; empty for none */
    public Duration after(Optional<Duration> retryAfter) {
        Duration delay = backoff.next();
        Duration asked = retryAfter.orElse(Duration.ZERO);
        Duration heeded = asked.compareTo(MAX_ASKED) < 0 ? asked : MAX_ASKED;
        return heeded.compareTo(delay) > 0 ? heeded : delay;
    }

    /** Called after an answer. */
    public void reset() {
        backoff.reset();
    }
}
