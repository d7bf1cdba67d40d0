package io.furrow.connect.repair;

import java.time.DateTimeException;
import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.subscription.Kept;

/** When a subscription last told something, where no watermark says it. */
final class LastTold {
    private LastTold() {}

    /** Of a subscription that was there before this task: its last success, else its making, which its id tells. */
    static Optional<Instant> of(Kept kept) {
        if (kept.state() == Kept.State.CREATED) {
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
