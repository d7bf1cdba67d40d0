package io.furrow.simulators.signal;

import java.time.Instant;
import java.util.Objects;

/**
 * A time from an instant on.
 *
 * @param until exclusive; null for ever
 */
public record Span(Instant from, Instant until) {
    public Span {
        Objects.requireNonNull(from);
        if (until != null && until.isBefore(from)) {
            throw new IllegalArgumentException("a time cannot end at " + until + ", before it begins at " + from);
        }
    }

    /** From an instant on, for ever. */
    public static Span since(Instant from) {
        return new Span(from, null);
    }

    public boolean holds(Instant time) {
        return !time.isBefore(from) && (until == null || time.isBefore(until));
    }

    /** Whether it has an instant in common with the time after one instant, up to and including another. */
    public boolean meets(Instant after, Instant upTo) {
        return !from.isAfter(upTo) && (until == null || until.isAfter(after));
    }
}
