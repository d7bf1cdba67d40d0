package io.furrow.replay.source;

import java.util.concurrent.TimeUnit;
import java.util.function.LongSupplier;

/**
 * The clock of schedules, which never steps back.
 *
 * @param nanos from an arbitrary origin
 */
record ReplayClock(LongSupplier nanos) {
    static final ReplayClock SYSTEM = new ReplayClock(System::nanoTime);

    /** Returns the time, ms. */
    long now() {
        return TimeUnit.NANOSECONDS.toMillis(nanos.getAsLong());
    }

    /** Returns the nanoseconds until a time of this clock, ms. */
    long nanosUntil(long time) {
        return TimeUnit.MILLISECONDS.toNanos(time) - nanos.getAsLong();
    }

    /** Returns the epoch ms at a time of this clock. */
    long wall(long time) {
        return System.currentTimeMillis() - (now() - time);
    }
}
