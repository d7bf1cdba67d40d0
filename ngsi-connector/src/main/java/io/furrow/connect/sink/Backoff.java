package io.furrow.connect.sink;

import java.time.Duration;

import io.furrow.connect.broker.Outcome;

/** How long to leave a context broker alone: twice as long after each failure, and at least as long as it asks for. */
final class Backoff {
    /** What a broker asks for is not followed blindly: a wrong date would stop the sink for years. */
    private static final Duration LONGEST_ASKED = Duration.ofHours(1);

    private final Duration first;
    private final Duration longest;
    private Duration next;

    Backoff(Duration first, Duration longest) {
        this.first = first;
        this.longest = longest;
        this.next = first;
    }

    Duration after(Outcome.Away away) {
        Duration wait = next;
        next = min(next.multipliedBy(2), longest);
        Duration asked = min(away.retryAfter().orElse(Duration.ZERO), LONGEST_ASKED);
        return asked.compareTo(wait) > 0 ? asked : wait;
    }

    /** It answered. */
    void reset() {
        next = first;
    }

    private static Duration min(Duration a, Duration b) {
        return a.compareTo(b) < 0 ? a : b;
    }
}
