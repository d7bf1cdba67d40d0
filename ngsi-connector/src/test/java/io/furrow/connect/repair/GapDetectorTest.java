package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;
import java.util.OptionalLong;

import org.junit.jupiter.api.Test;

import io.furrow.connect.repair.GapDetector.Arrived;
import io.furrow.connect.repair.GapDetector.Result;
import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.SubscriptionStatus;
import io.furrow.connect.subscription.SubscriptionStatus.State;

import static org.assertj.core.api.Assertions.assertThat;

class GapDetectorTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");

    private final GapDetector gapDetector = new GapDetector(true);

    @Test
    void cannotTellAtTheFirstLook() {
        assertThat(look(sent(5, T), 0)).isInstanceOf(Result.FirstPoll.class);
    }

    @Test
    void isBalancedWhenAllThatWasBegunHasCome() {
        look(sent(5, T), 0);

        assertThat(look(sent(8, T.plusSeconds(10)), 1)).isInstanceOf(Result.InFlight.class);
        assertThat(look(sent(9, T.plusSeconds(20)), 4)).isEqualTo(new Result.Balanced(T.plusSeconds(20)));
    }

    @Test
    void missesWhatWasBegunAtTheLookBeforeAndHasNotCome() {
        look(sent(5, T), 0);
        look(sent(8, T.plusSeconds(10)), 3);
        look(sent(12, T.plusSeconds(20)), 6);

        assertThat(look(sent(12, T.plusSeconds(30)), 6))
                .isEqualTo(missing("1 notifications were sent and did not arrive"));
        assertThat(look(sent(12, T.plusSeconds(40)), 6)).isInstanceOf(Result.Balanced.class);
    }

    /** The next ones hide it: more have come than had been begun at the look before. */
    @Test
    void missesOneAmongManyThatGoOnComing() {
        look(sent(0, T), 0);
        for (int i = 1; i < GapDetector.MAX_UNBALANCED; i++) {
            assertThat(look(sent(100 * i, T.plusSeconds(10L * i)), 100 * i - 1)).isInstanceOf(Result.InFlight.class);
        }

        assertThat(look(sent(9000, T.plusSeconds(900)), 8999))
                .isEqualTo(missing("sent and arrived notifications have differed for 30 looks"));
    }

    @Test
    void countsFromTheEndOfARepair() {
        look(sent(5, T), 0);
        look(sent(9, T.plusSeconds(10)), 0);
        look(sent(9, T.plusSeconds(20)), 0);
        gapDetector.repaired(2);

        assertThat(look(sent(10, T.plusSeconds(30)), 3)).isEqualTo(new Result.Balanced(T.plusSeconds(30)));
    }

    /** A crash loses the queue and what was counted of it. */
    @Test
    void missesWhatARestartOfTheContextBrokerMayHaveLost() {
        look(sent(1000, T), 0);
        look(sent(2000, T.plusSeconds(10)), 1000);

        assertThat(look(sent(1400, T.plusSeconds(20)), 1000))
                .isEqualTo(missing("the context broker's counters went back"));
        look(sent(1700, T.plusSeconds(30)), 1100);
        assertThat(look(sent(1700, T.plusSeconds(40)), 1100))
                .isEqualTo(missing("200 notifications were sent and did not arrive"));
    }

    @Test
    void missesWhatIsBehindALastSuccessThatGoesBack() {
        look(report(5, 0, Optional.empty(), Optional.of(T)), 0);

        assertThat(look(report(5, 0, Optional.empty(), Optional.of(T.minusSeconds(60))), 0))
                .isEqualTo(missing("the context broker's counters went back"));
        assertThat(look(report(5, 0, Optional.empty(), Optional.empty()), 0))
                .isEqualTo(missing("the context broker's counters went back"));
    }

    @Test
    void missesWhatCountersCannotTellThatAreNoNumbers() {
        look(sent(5, T), 0);

        assertThat(look(
                        kept(
                                State.AT_WORK,
                                new DeliveryReport(OptionalLong.empty(), 0, Optional.empty(), Optional.empty())),
                        0))
                .isEqualTo(missing("the context broker's counters cannot be read"));
    }

    @Test
    void missesWhatCouldNotBeDeliveredEvenIfTheNextOneCould() {
        look(sent(5, T), 0);

        assertThat(look(report(7, 0, Optional.of(T), Optional.of(T)), 2))
                .isEqualTo(missing("the context broker could not deliver"));
        assertThat(look(report(8, 1, Optional.of(T), Optional.of(T)), 3))
                .as("within the same second")
                .isInstanceOf(Result.Missing.class);
    }

    @Test
    void missesWhatASubscriptionCouldNotTellThatWasGoneOrStopped() {
        look(sent(5, T), 0);

        assertThat(look(kept(State.RESUMED, sent(5, T).report()), 0))
                .isEqualTo(missing("the subscription did not notify this source"));
        assertThat(look(kept(State.CREATED, DeliveryReport.NOTHING_SENT), 0))
                .isEqualTo(missing("the subscription was removed"));
    }

    private Result look(SubscriptionStatus kept, long arrived) {
        return gapDetector.look(kept, new Arrived(arrived, arrived));
    }

    private static Result missing(String reason) {
        return new Result.Missing(reason);
    }

    private static SubscriptionStatus sent(long times, Instant at) {
        DeliveryReport report = new DeliveryReport(OptionalLong.of(times), 0, Optional.empty(), Optional.empty());
        return new SubscriptionStatus("s", State.AT_WORK, report, at, Optional.empty());
    }

    private static SubscriptionStatus report(
            long times, long fails, Optional<Instant> lastFailure, Optional<Instant> lastSuccess) {
        return kept(State.AT_WORK, new DeliveryReport(OptionalLong.of(times), fails, lastFailure, lastSuccess));
    }

    private static SubscriptionStatus kept(State state, DeliveryReport report) {
        return new SubscriptionStatus("s", state, report, T.plusSeconds(10), Optional.empty());
    }
}
