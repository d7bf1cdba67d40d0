package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.Optional;

/**
 * A subscription after it was polled, and created or changed if necessary.
 *
 * @param id in the context broker
 * @param state in which it was found
 * @param report from before this poll
 * @param at time of the poll, by the clock of the context broker
 * @param lastKnown when a predecessor for another number of tasks last notified; only if the subscription is new
 */
public record SubscriptionStatus(
        String id, State state, DeliveryReport report, Instant at, Optional<Instant> lastKnown) {
    /** The state in which the subscription was found. */
    public enum State {
        /** It was active and notified this source. */
        AT_WORK,
        /** It existed, but had expired, had been stopped, or notified another address. */
        RESUMED,
        /** It did not exist. */
        CREATED
    }
}
