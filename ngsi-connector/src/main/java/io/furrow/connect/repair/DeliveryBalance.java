package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.Kept;

/**
 * Holds what a context broker says it sent against what arrived, look by look. What it had begun to send at one look must have
 * arrived by the next; what it says has failed is missing at once, and so is what it cannot say. The books balance when all
 * that was begun has arrived; where that does not happen for {@value #MOST_UNBALANCED} looks, something may be missing.
 */
final class DeliveryBalance {
    static final int MOST_UNBALANCED = 30;

    /** What a look shows. */
    sealed interface Verdict {
        /** All that was begun up to {@code until} has arrived. */
        record Balanced(Instant until) implements Verdict {}

        /** Some is on its way. */
        record Open() implements Verdict {}

        /** Something is or may be missing. */
        record Missing(String reason) implements Verdict {}

        /** There was no look before to compare with. */
        record First() implements Verdict {}
    }

    /**
     * Notifications of the subscription that arrived since the start.
     *
     * @param before the context broker was asked
     * @param after it answered
     */
    record Arrived(long before, long after) {}

    private final boolean countable;

    private record Look(Kept kept, Arrived arrived) {
        DeliveryReport report() {
            return kept.report();
        }

        long sent() {
            return report().timesSent().orElse(0);
        }
    }

    private Optional<Look> last = Optional.empty();
    private long baseSent;
    private long baseArrived;
    private int unbalanced;

    /** @param countable whether a notification says which subscription it is of; else only failures are found */
    DeliveryBalance(boolean countable) {
        this.countable = countable;
    }

    /** What came of the context broker since the look before. */
    Verdict look(Kept kept, Arrived arrived) {
        Look now = new Look(kept, arrived);
        Verdict verdict = last.isEmpty() ? new Verdict.First() : compare(last.get(), now);
        last = Optional.of(now);
        unbalanced = verdict instanceof Verdict.Open ? unbalanced + 1 : 0;
        if (unbalanced == MOST_UNBALANCED) {
            verdict = new Verdict.Missing(
                    "sent and arrived notifications have differed for " + MOST_UNBALANCED + " looks");
        }
        if (verdict instanceof Verdict.Missing || verdict instanceof Verdict.First) {
            repaired(arrived.after());
        }
        return verdict;
    }

    /**
     * All that had been begun at the last look was read again: counting begins there.
     *
     * @param arrived until the end of the reading; what was begun before and arrives later tells nothing new and is not counted
     */
    void repaired(long arrived) {
        baseSent = last.orElseThrow().sent();
        baseArrived = arrived;
        unbalanced = 0;
    }

    private Verdict compare(Look before, Look now) {
        return failure(before.kept(), now.kept())
                .map(reason -> (Verdict) new Verdict.Missing(reason))
                .orElseGet(() -> count(before, now));
    }

    private Optional<String> failure(Kept before, Kept now) {
        DeliveryReport then = before.report();
        DeliveryReport report = now.report();
        if (now.state() == Kept.State.CREATED || !before.id().equals(now.id())) {
            return Optional.of("the subscription was gone");
        }
        if (now.state() == Kept.State.RESUMED) {
            return Optional.of("the subscription did not tell us");
        }
        if (!report.lastFailure().equals(then.lastFailure()) || report.failsInARow() > then.failsInARow()) {
            return Optional.of("the context broker could not deliver");
        }
        if (report.timesSent().isEmpty()) {
            return Optional.of("the context broker's counters cannot be read");
        }
        boolean successLost = then.lastSuccess()
                .filter(time -> report.lastSuccess()
                        .filter(later -> !later.isBefore(time))
                        .isEmpty())
                .isPresent();
        if (successLost || report.timesSent().getAsLong() < then.timesSent().orElse(0)) {
            return Optional.of("the context broker's counters went back");
        }
        return Optional.empty();
    }

    private Verdict count(Look before, Look now) {
        if (!countable) {
            return new Verdict.Balanced(before.kept().at());
        }
        long missing = before.sent() - baseSent - (now.arrived().after() - baseArrived);
        if (missing > 0) {
            return new Verdict.Missing(missing + " notifications were sent and did not arrive");
        }
        return now.sent() - baseSent == now.arrived().before() - baseArrived
                ? new Verdict.Balanced(now.kept().at())
                : new Verdict.Open();
    }
}
