package io.furrow.dashboard.feed;

import org.junit.jupiter.api.Test;

import io.furrow.dashboard.http.Problem;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class StateBudgetTest {
    private final StateBudget budget = new StateBudget(100);

    @Test
    void refusesAStateWithoutRoomUntilOthersAreReleased() {
        StateBudget.Share one = budget.share();
        one.resize(60, "a");
        one.hold(1);
        StateBudget.Share other = budget.share();
        other.resize(40, "b");
        assertThatThrownBy(() -> other.resize(41, "b"))
                .isInstanceOf(Problem.class)
                .hasMessageContaining("again in some seconds");
        other.resize(30, "b");
        one.release();
        assertThat(budget.used()).isEqualTo(90);
        one.release();
        other.resize(100, "b");
        other.release();
        assertThat(budget.used()).isZero();
    }
}
