package io.furrow.provisioner;

import java.time.Duration;
import java.util.function.LongSupplier;

import io.furrow.model.time.Backoff;

/** Schedules the provisioner's steps: immediately if work is left, with increasing backoff after failures, else at an interval. */
final class RetrySchedule {
    static final Duration FIRST = Duration.ofMillis(200);
    static final Duration MAX = Duration.ofSeconds(10);

    private final LongSupplier nanos;
    private final Duration interval;
    private long due;
    private final Backoff backoff = new Backoff(FIRST, MAX);
    private boolean failing;
    private boolean refreshDue;

    /** @param interval between complete checks, which restore registrations that the agent has lost */
    RetrySchedule(LongSupplier nanos, Duration interval) {
        this.nanos = nanos;
        this.interval = interval;
        this.due = nanos.getAsLong();
    }

    /** Schedules a step immediately because of new requests, unless steps are failing. */
    void requested() {
        if (!failing) {
            refreshDue = false;
            runNow();
        }
    }

    /** Schedules the next step immediately. */
    void runNow() {
        due = nanos.getAsLong();
    }

    /** Schedules the next complete check after the interval. */
    void succeeded() {
        due = nanos.getAsLong() + interval.toNanos();
        failing = false;
        backoff.reset();
        refreshDue = true;
    }

    /** Schedules a retry. @return whether this is the first failure in a row */
    boolean failed() {
        boolean first = !failing;
        due = nanos.getAsLong() + backoff.next().toNanos();
        failing = true;
        refreshDue = true;
        return first;
    }

    boolean isDue() {
        return nanos.getAsLong() >= due;
    }

    /** Whether the step must read the agent again: the first one after a failure or a complete check. */
    boolean isRefreshDue() {
        boolean refresh = refreshDue;
        refreshDue = false;
        return refresh;
    }

    /** Returns the time until the next step, at most {@code max}. */
    Duration pause(Duration max) {
        long left = Math.max(0, due - nanos.getAsLong());
        return left < max.toNanos() ? Duration.ofNanos(left) : max;
    }
}
