package io.furrow.connect.sink.api;

import java.time.Duration;

import io.furrow.connect.broker.Outcome;
import io.furrow.model.time.Backoff;

/** How long to leave a context broker alone: twice as long after each failure, and at least as long as it asks for. */
public final class BrokerBackoff {
    /** What a broker asks for is not followed blindly: a wrong date would stop the sink for years. */
    private static final Duration MAX_ASKED = Duration.ofHours(1);

    private final Backoff backoff;

    public BrokerBackoff(Duration min, Duration max) {
        backoff = new Backoff(min, max);
    }

    public Duration after(Outcome.Unavailable unavailable) {
        Duration delay = backoff.next();
        Duration asked = unavailable.retryAfter().orElse(Duration.ZERO);
        Duration heeded = asked.compareTo(MAX_ASKED) < 0 ? asked : MAX_ASKED;
        return heeded.compareTo(delay) > 0 ? heeded : delay;
    }

    /** After an answer that names no time. */
    public Duration after() {
        return backoff.next();
    }

    /** It answered. */
    public void reset() {
        backoff.reset();
    }
}
