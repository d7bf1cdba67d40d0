package io.furrow.provisioner;

import java.time.Duration;
import java.util.function.LongSupplier;

import io.furrow.model.time.Backoff;

/** When the provisioner goes to work again: at once where there is more, later and later while it fails, else at an interval. */
final class RetrySchedule {
    static final Duration FIRST = Duration.ofMillis(200);
    static final Duration MAX = Duration.ofSeconds(10);

    private final LongSupplier nanos;
    private final Duration interval;
    private long due;
    private final Backoff backoff = new Backoff(FIRST, MAX);
    private boolean failing;
    private boolean again;

    /** @param interval after which all is looked at again, so that what the agent has lost in the meantime comes back */
    RetrySchedule(LongSupplier nanos, Duration interval) {
        this.nanos = nanos;
        this.interval = interval;
        this.due = nanos.getAsLong();
    }

    /** Something new is requested: at once, but where it fails not earlier than else. */
    void hurry() {
        if (!failing) {
            again = false;
            goOn();
        }
    }

    /** There is more to do: at once. */
    void goOn() {
        due = nanos.getAsLong();
    }

    /** All is done. */
    void rest() {
        due = nanos.getAsLong() + interval.toNanos();
        failing = false;
        backoff.reset();
        again = true;
    }

    /** @return whether it is the first time in a row */
    boolean failed() {
        boolean first = !failing;
        due = nanos.getAsLong() + backoff.next().toNanos();
        failing = true;
        again = true;
        return first;
    }

    boolean isDue() {
        return nanos.getAsLong() >= due;
    }

    /** Whether the step that begins is to take nothing for granted: the first one after a failure or a rest. */
    boolean isRefreshDue() {
        boolean refresh = again;
        again = false;
        return refresh;
    }

    /** Until it is due, but not longer than so. */
    Duration pause(Duration most) {
        long left = Math.max(0, due - nanos.getAsLong());
        return left < most.toNanos() ? Duration.ofNanos(left) : most;
    }
}
