package io.furrow.connect.repair;

import java.time.Duration;
import java.util.HashSet;
import java.util.Set;
import java.util.function.LongSupplier;

/**
 * Schedules the listing of all ids: immediately if urgent, else when an interval has passed since the last one. A listing
 * that lacks most known entities may come from a context broker whose database is not mounted: the next one follows
 * after {@link #AGREEMENT}, and only entities that both lack count as deleted.
 */
final class ListingSchedule {
    static final Duration AGREEMENT = Duration.ofSeconds(60);
    /** A listing that lacks no more is trusted. */
    static final int MAX_TRUSTED = 5;

    private final long intervalNanos;
    private final LongSupplier nanos;
    private boolean urgent;
    private boolean due;
    private boolean listed;
    private long listedAt;
    private Set<String> unconfirmed = Set.of();
    /** Becomes {@link #unconfirmed} once the confirmed deletions are done. */
    private Set<String> next = Set.of();

    ListingSchedule(Duration interval, LongSupplier nanos) {
        intervalNanos = interval.toNanos();
        this.nanos = nanos;
    }

    void demand(boolean isUrgent) {
        urgent |= isUrgent;
        due = true;
    }

    boolean isNow() {
        long passed = nanos.getAsLong() - listedAt;
        return unconfirmed.isEmpty()
                ? urgent || due && (!listed || passed >= intervalNanos)
                : passed >= AGREEMENT.toNanos();
    }

    /**
     * Returns the missing entities that count as deleted.
     *
     * @param known number of entities that a complete listing has
     */
    Set<String> deleted(Set<String> missing, int known) {
        next = new HashSet<>();
        if (missing.size() > MAX_TRUSTED && 2L * missing.size() > known) {
            next.addAll(missing);
            next.removeAll(unconfirmed);
        }
        Set<String> deleted = new HashSet<>(missing);
        deleted.removeAll(next);
        return deleted;
    }

    /** Called when the deletions of a listing are emitted. */
    void done() {
        unconfirmed = next;
        next = Set.of();
        urgent = false;
        due = false;
        listed = true;
        listedAt = nanos.getAsLong();
    }

    /** The number of entities that the last listing lacked and that the next one may confirm as deleted. */
    int unconfirmed() {
        return unconfirmed.size();
    }
}
