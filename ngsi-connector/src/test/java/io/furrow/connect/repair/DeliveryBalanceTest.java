package io.furrow.connect.repair;

import java.time.Instant;
import java.util.Optional;

import org.junit.jupiter.api.Test;

import io.furrow.connect.repair.DeliveryBalance.Verdict;
import io.furrow.connect.subscription.DeliveryReport;
import io.furrow.connect.subscription.Kept;
import io.furrow.connect.subscription.Kept.State;

import static org.assertj.core.api.Assertions.assertThat;

class DeliveryBalanceTest {
    private static final Instant T = Instant.parse("2026-11-21T12:00:00Z");

    private final DeliveryBalance balance = new DeliveryBalance(true);

    @Test
    void cannotTellAtTheFirstLook() {
        assertThat(balance.look(sent(5, T), 0)).isInstanceOf(Verdict.First.class);
    }

    @Test
    void isBalancedUpToTheLookBeforeWhenAllThatWasBegunByThenHasCome() {
        balance.look(sent(5, T), 0);
        assertThat(balance.look(sent(8, T.plusSeconds(10)), 1)).isEqualTo(new Verdict.Balanced(T));
        assertThat(balance.look(sent(9, T.plusSeconds(20)), 3)).isEqualTo(new Verdict.Balanced(T.plusSeconds(10)));
    }

    @Test
    void missesWhatWasBegunAtTheLookBeforeAndHasNotCome() {
        balance.look(sent(5, T), 0);
        balance.look(sent(8, T.plusSeconds(10)), 3);
        balance.look(sent(12, T.plusSeconds(20)), 6);

        assertThat(balance.look(sent(12, T.plusSeconds(30)), 6))
                .isEqualTo(new Verdict.Missing("1 notifications were sent and did not arrive"));
        assertThat(balance.look(sent(12, T.plusSeconds(40)), 6)).isInstanceOf(Verdict.Balanced.class);
    }

    @Test
    void missesWhatCouldNotBeDeliveredEvenIfTheNextOneCould() {
        balance.look(sent(5, T), 0);

        assertThat(balance.look(kept(State.AT_WORK, new DeliveryReport(7, 0, Optional.of(T), Optional.of(T))), 2))
                .isEqualTo(new Verdict.Missing("the context broker could not deliver"));
        assertThat(balance.look(kept(State.AT_WORK, new DeliveryReport(8, 1, Optional.of(T), Optional.of(T))), 3))
                .as("within the same second")
                .isInstanceOf(Verdict.Missing.class);
    }

    @Test
    void missesWhatASubscriptionCouldNotTellThatWasGoneOrStopped() {
        balance.look(sent(5, T), 0);

        assertThat(balance.look(kept(State.RESUMED, new DeliveryReport(5, 0, Optional.empty(), Optional.empty())), 0))
                .isEqualTo(new Verdict.Missing("the subscription did not tell us"));
        assertThat(balance.look(kept(State.CREATED, DeliveryReport.NOTHING_SENT), 0))
                .isEqualTo(new Verdict.Missing("the subscription was gone"));
    }

    private static Kept sent(long times, Instant at) {
        DeliveryReport report = new DeliveryReport(times, 0, Optional.empty(), Optional.empty());
        return new Kept("s", State.AT_WORK, report, at, Optional.empty());
    }

    private static Kept kept(State state, DeliveryReport report) {
        return new Kept("s", state, report, T.plusSeconds(10), Optional.empty());
    }
}
