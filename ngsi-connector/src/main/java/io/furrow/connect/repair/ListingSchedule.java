package io.furrow.connect.repair;

import java.time.Duration;
import java.util.HashSet;
import java.util.Set;
import java.util.function.LongSupplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.event.FiwareScope;

/**
 * Schedules the listing of all ids: immediately if urgent, else when an interval has passed since the last one. A listing
 * that lacks most known entities may come from a context broker whose database is not mounted: the next one follows
 * after {@link #AGREEMENT}, and only entities that both lack count as deleted.
 */
final class ListingSchedule {
    private static final Logger LOG = LoggerFactory.getLogger(ListingSchedule.class);

    static final Duration AGREEMENT = Duration.ofSeconds(60);
    /** A listing that lacks no more is trusted. */
    static final int MAX_TRUSTED = 5;

    private final FiwareScope scope;
    private final long intervalNanos;
    private final LongSupplier nanos;
    private boolean urgent;
    private boolean due;
    private boolean listed;
    private long listedAt;
    private Set<String> unconfirmed = Set.of();
    /** Becomes {@link #unconfirmed} once the confirmed deletions are done. */
    private Set<String> next = Set.of();

    private int known;
    private volatile String problem = "";

    ListingSchedule(FiwareScope scope, Duration interval, LongSupplier nanos) {
        this.scope = scope;
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
        this.known = known;
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
        problem = unconfirmed.isEmpty()
                ? ""
                : "the context broker lacks %d of %d known entities of tenant '%s' at %s; those that it still lacks in %d s are deleted on the topic; check that its database is mounted, and context.broker.url"
                        .formatted(
                                unconfirmed.size(), known, scope.service(), scope.servicePath(), AGREEMENT.toSeconds());
        if (!problem.isEmpty()) {
            LOG.warn(problem);
        }
    }

    /** What the last listing lacked, unless it is trusted, and what to do; empty for nothing. */
    String problem() {
        return problem;
    }
}
