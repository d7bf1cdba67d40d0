package io.furrow.control.provisioning;

import java.time.Duration;
import java.util.function.LongSupplier;

/** When the provisioner goes to work again: at once where there is more, later and later while it fails, else at an interval. */
final class Pace {
    static final Duration FIRST = Duration.ofMillis(200);
    static final Duration LONGEST = Duration.ofSeconds(10);

    private final LongSupplier nanos;
    private final Duration interval;
    private long due;
    private int failures;
    private boolean again;

    /** @param interval after which all is looked at again, so that what the agent has lost in the meantime comes back */
    Pace(LongSupplier nanos, Duration interval) {
        this.nanos = nanos;
        this.interval = interval;
        this.due = nanos.getAsLong();
    }

    /** Something new is wanted: at once, but where it fails not earlier than else. */
    void hurry() {
        if (failures == 0) {
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
        failures = 0;
        again = true;
    }

    /** @return whether it is the first time in a row */
    boolean failed() {
        long pause = Math.min(FIRST.toNanos() << Math.min(failures, 20), LONGEST.toNanos());
        due = nanos.getAsLong() + pause;
        failures++;
        again = true;
        return failures == 1;
    }

    boolean isDue() {
        return nanos.getAsLong() >= due;
    }

    /** Whether the step that begins is to take nothing for granted: the first one after a failure or a rest. */
    boolean looksAgain() {
        boolean looks = again;
        again = false;
        return looks;
    }

    /** Until it is due, but not longer than so. */
    Duration pause(Duration most) {
        long left = Math.max(0, due - nanos.getAsLong());
        return left < most.toNanos() ? Duration.ofNanos(left) : most;
    }
}
