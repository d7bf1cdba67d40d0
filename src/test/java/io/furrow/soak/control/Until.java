package io.furrow.soak.control;

import java.time.Duration;
import java.util.concurrent.locks.LockSupport;
import java.util.function.BooleanSupplier;

/** Waits for a condition, and names it if it did not become true. */
public final class Until {
    private static final long POLL_NANOS = Duration.ofMillis(100).toNanos();

    private Until() {}

    /** @throws IllegalStateException if it does not become true in time */
    public static void isTrue(String what, Duration timeout, BooleanSupplier condition) {
        if (!within(timeout, condition)) {
            throw new IllegalStateException("not within " + timeout.toSeconds() + " s: " + what);
        }
    }

    /** Whether it became true in time. */
    public static boolean within(Duration timeout, BooleanSupplier condition) {
        long end = System.nanoTime() + timeout.toNanos();
        while (!condition.getAsBoolean()) {
            if (System.nanoTime() > end || Thread.currentThread().isInterrupted()) {
                return false;
            }
            LockSupport.parkNanos(POLL_NANOS);
        }
        return true;
    }
}
