package io.furrow.provisioner;

import java.time.Duration;
import java.util.function.LongSupplier;

/** The time within which a step begins requests; a request that has begun is finished. */
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
