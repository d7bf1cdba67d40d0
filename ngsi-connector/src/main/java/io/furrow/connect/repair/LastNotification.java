package io.furrow.connect.repair;

import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.subscription.SubscriptionStatus;

/** The time at which a subscription last notified, if no watermark exists. */
final class LastNotification {
    private LastNotification() {}

    /**
     * For a subscription that existed before this task: its last success, else its creation time, which its id
     * contains.
     */
    static Optional<Instant> of(SubscriptionStatus kept) {
        if (kept.state() == SubscriptionStatus.State.CREATED) {
            return kept.lastKnown();
        }
        return kept.report().lastSuccess().or(() -> madeAt(kept.id()));
    }

    /** The first eight of the 24 digits of a MongoDB id are seconds. */
    private static Optional<Instant> madeAt(String id) {
        try {
            return id.matches("[0-9a-f]{24}")
                    ? Optional.of(Instant.ofEpochSecond(Long.parseLong(id.substring(0, 8), 16)))
                    : Optional.empty();
        } catch (DateTimeException e) {
            return Optional.empty();
        }
    }
}
