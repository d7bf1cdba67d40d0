package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.SubscriptionStatus;

/**
 * Compares the notifications that a context broker reports as sent with those that arrived, poll by poll. Notifications
 * begun at one poll must have arrived by the next; reported failures and unknown counters count as missing immediately.
 * The balance is even when all begun notifications have arrived; if it is not for {@value #MAX_UNBALANCED} polls,
 * notifications may be missing.
 */
final class GapDetector {
    static final int MAX_UNBALANCED = 30;

    /** The result of a poll. */
    sealed interface Result {
        /** All notifications begun up to {@code until} have arrived. */
        record Balanced(Instant until) implements Result {}

        /** Some notifications are in flight. */
        record InFlight() implements Result {}

        /** Notifications are or may be missing. */
        record Missing(String reason) implements Result {}

        /** There was no previous poll to compare with. */
        record FirstPoll() implements Result {}
    }

    /**
     * Notifications of the subscription that arrived since the start.
     *
     * @param before the context broker was polled
     * @param after it answered
     */
    record Arrived(long before, long after) {}

    private final boolean countable;

    private record Poll(SubscriptionStatus kept, Arrived arrived) {
        DeliveryReport report() {
            return kept.report();
        }

        long sent() {
            return report().timesSent().orElse(0);
        }
    }

    private Optional<Poll> last = Optional.empty();
    private long baseSent;
    private long baseArrived;
    private int unbalanced;

    /** @param countable whether a notification names its subscription; otherwise only failures are detected */
    GapDetector(boolean countable) {
        this.countable = countable;
    }

    /** The change since the previous poll. */
    Result look(SubscriptionStatus kept, Arrived arrived) {
        Poll now = new Poll(kept, arrived);
        Result result = last.isEmpty() ? new Result.FirstPoll() : compare(last.get(), now);
        last = Optional.of(now);
        unbalanced = result instanceof Result.InFlight ? unbalanced + 1 : 0;
        if (unbalanced == MAX_UNBALANCED) {
            result =
                    new Result.Missing("sent and arrived notifications have differed for " + MAX_UNBALANCED + " looks");
        }
        if (result instanceof Result.Missing || result instanceof Result.FirstPoll) {
            repaired(arrived.after());
        }
        return result;
    }

    /**
     * Everything begun at the last poll was read again: counting restarts there.
     *
     * @param arrived until the end of the reading; notifications begun before that arrive later are duplicates and
     *     are not counted
     */
    void repaired(long arrived) {
        baseSent = last.orElseThrow().sent();
        baseArrived = arrived;
        unbalanced = 0;
    }

    private Result compare(Poll before, Poll now) {
        return failure(before.kept(), now.kept())
                .map(reason -> (Result) new Result.Missing(reason))
                .orElseGet(() -> count(before, now));
    }

    private Optional<String> failure(SubscriptionStatus before, SubscriptionStatus now) {
        DeliveryReport then = before.report();
        DeliveryReport report = now.report();
        if (now.state() == SubscriptionStatus.State.CREATED || !before.id().equals(now.id())) {
            return Optional.of("the subscription was removed");
        }
        if (now.state() == SubscriptionStatus.State.RESUMED) {
            return Optional.of("the subscription did not notify this source");
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

    private Result count(Poll before, Poll now) {
        if (!countable) {
            return new Result.Balanced(before.kept().at());
        }
        long missing = before.sent() - baseSent - (now.arrived().after() - baseArrived);
        if (missing > 0) {
            return new Result.Missing(missing + " notifications were sent and did not arrive");
        }
        return now.sent() - baseSent == now.arrived().before() - baseArrived
                ? new Result.Balanced(now.kept().at())
                : new Result.InFlight();
    }
}
