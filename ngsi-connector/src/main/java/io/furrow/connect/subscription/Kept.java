package io.furrow.connect.subscription;

import java.time.Instant;
import java.util.Optional;

/**
 * A subscription after it was looked at, and made or changed where it had to be.
 *
 * @param id in the context broker
 * @param state what it was found in
 * @param report of before this look
 * @param at when, by the clock of the context broker
 * @param lastKnown when a predecessor of this one was last told something: one for another number of tasks; only if new
 */
public record Kept(String id, State state, DeliveryReport report, Instant at, Optional<Instant> lastKnown) {
    /** How the subscription was found. */
    public enum State {
        /** It was at work and told us. */
        AT_WORK,
        /** It was there, but had ended, had been stopped, or told somebody else. */
        RESUMED,
        /** It was not there. */
        CREATED
    }
}
