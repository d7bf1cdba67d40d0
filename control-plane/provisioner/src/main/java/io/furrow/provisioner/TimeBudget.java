package io.furrow.provisioner;

import java.time.Duration;
import java.util.function.LongSupplier;

/** Limits the time in which a step starts requests; a started request is finished. */
final class TimeBudget {
    private final LongSupplier nanos;
    private final long end;

    TimeBudget(Duration time, LongSupplier nanos) {
        this.nanos = nanos;
        this.end = nanos.getAsLong() + time.toNanos();
    }

    boolean isSpent() {
        return nanos.getAsLong() - end >= 0;
    }
}
