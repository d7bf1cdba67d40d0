package io.furrow.replay.source;

import java.util.concurrent.TimeUnit;
import java.util.function.LongSupplier;

/**
 * The clock of schedules, which never steps back.
 *
 * @param nanos from any beginning
 */
record ReplayClock(LongSupplier nanos) {
    static final ReplayClock SYSTEM = new ReplayClock(System::nanoTime);

    /** Now, ms. */
    long now() {
        return TimeUnit.NANOSECONDS.toMillis(nanos.getAsLong());
    }

    /** Nanoseconds from now until a time of this clock, ms. */
    long nanosUntil(long time) {
        return TimeUnit.MILLISECONDS.toNanos(time) - nanos.getAsLong();
    }

    /** Epoch ms at a time of this clock. */
    long wall(long time) {
        return System.currentTimeMillis() - (now() - time);
    }
}
