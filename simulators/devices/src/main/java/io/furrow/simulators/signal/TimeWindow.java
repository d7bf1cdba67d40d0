package io.furrow.simulators.signal;

import java.time.Instant;
import java.util.Objects;

/**
 * A period of time.
 *
 * @param until exclusive; null for no end
 */
public record TimeWindow(Instant from, Instant until) {
    public TimeWindow {
        Objects.requireNonNull(from);
        if (until != null && until.isBefore(from)) {
            throw new IllegalArgumentException("a period cannot end at " + until + ", before its start at " + from);
        }
    }

    public boolean holds(Instant time) {
        return !time.isBefore(from) && (until == null || time.isBefore(until));
    }
}
