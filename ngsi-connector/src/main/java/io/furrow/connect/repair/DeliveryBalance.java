package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.Kept;

/**
 * Holds what a context broker says it sent against what was received, look by look. What it had begun to send at one look must
 * have arrived by the next; what it says has failed is missing at once.
 */
final class DeliveryBalance {
    /** What a look shows. */
    sealed interface Verdict {
        /** All that was begun up to {@code until} is durable here. */
        record Balanced(Instant until) implements Verdict {}

        /** Something is or may be missing. */
        record Missing(String reason) implements Verdict {}

        /** There was no look before to compare with. */
        record First() implements Verdict {}
    }

    private final boolean countable;

    /** @param countable whether a notification says which subscription it is of; else only failures are found */
    DeliveryBalance(boolean countable) {
        this.countable = countable;
    }

    private record Look(String id, DeliveryReport report, long received, Instant at) {}

    private Optional<Look> last = Optional.empty();
    /** What {@code last} is counted from: a look after which all was repaired. */
    private Optional<Look> base = Optional.empty();

    /** @param received notifications of this subscription that are durable, since the start, counted before the look */
    Verdict look(Kept kept, long received) {
        Look now = new Look(kept.id(), kept.report(), received, kept.at());
        Verdict verdict = verdict(kept.state(), now);
        if (!(verdict instanceof Verdict.Balanced)) {
            base = Optional.of(now);
        }
        last = Optional.of(now);
        return verdict;
    }

    private Verdict verdict(Kept.State state, Look now) {
        if (last.isEmpty()) {
            return new Verdict.First();
        }
        Look before = last.get();
        if (state == Kept.State.CREATED || !before.id().equals(now.id())) {
            return new Verdict.Missing("the subscription was gone");
        }
        if (state == Kept.State.RESUMED) {
            return new Verdict.Missing("the subscription did not tell us");
        }
        if (!now.report().lastFailure().equals(before.report().lastFailure())
                || now.report().failsInARow() > before.report().failsInARow()) {
            return new Verdict.Missing("the context broker could not deliver");
        }
        long begun = before.report().timesSent() - base.orElseThrow().report().timesSent();
        long arrived = now.received() - base.orElseThrow().received();
        if (countable && begun > arrived) {
            return new Verdict.Missing((begun - arrived) + " notifications were sent and did not arrive");
        }
        return new Verdict.Balanced(before.at());
    }
}
