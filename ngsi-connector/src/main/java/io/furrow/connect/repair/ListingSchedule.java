package io.furrow.connect.repair;

import java.time.Duration;

/** Schedules the listing of all ids: immediately if urgent, else when an interval has passed since the last one. */
final class ListingSchedule {
    private final long intervalNanos;
    private boolean urgent;
    private boolean due;
    private boolean listed;
    private long listedAt;

    ListingSchedule(Duration interval) {
        intervalNanos = interval.toNanos();
    }

    void demand(boolean isUrgent) {
        urgent |= isUrgent;
        due = true;
    }

    boolean isNow() {
        return urgent || due && (!listed || System.nanoTime() - listedAt >= intervalNanos);
    }

    void done() {
        urgent = false;
        due = false;
        listed = true;
        listedAt = System.nanoTime();
    }
}
