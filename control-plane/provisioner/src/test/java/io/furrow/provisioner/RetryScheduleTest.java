package io.furrow.provisioner;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class RetryScheduleTest {
    private static final Duration LONG = Duration.ofHours(1);

    private long now;
    private final RetrySchedule retrySchedule = new RetrySchedule(() -> now, Duration.ofSeconds(30));

    @Test
    void waitsLongerAfterEachFailureUpToTenSeconds() {
        List<Long> pauses = new ArrayList<>();
        for (int i = 0; i < 8; i++) {
            assertThat(retrySchedule.failed()).isEqualTo(i == 0);
            pauses.add(retrySchedule.pause(LONG).toMillis());
            now += retrySchedule.pause(LONG).toNanos();
        }

        assertThat(pauses).containsExactly(200L, 400L, 800L, 1600L, 3200L, 6400L, 10_000L, 10_000L);
    }

    @Test
    void runsNewRequestsImmediatelyUnlessStepsFail() {
        retrySchedule.succeeded();
        assertThat(retrySchedule.isDue()).isFalse();
        retrySchedule.requested();
        assertThat(retrySchedule.isDue()).isTrue();

        retrySchedule.failed();
        retrySchedule.requested();
        assertThat(retrySchedule.isDue()).isFalse();
    }

    @Test
    void refreshesOnceAfterAFailureOrACompleteCheck() {
        assertThat(retrySchedule.isRefreshDue()).isFalse();
        retrySchedule.failed();
        assertThat(retrySchedule.isRefreshDue()).isTrue();
        retrySchedule.runNow();
        assertThat(retrySchedule.isRefreshDue()).isFalse();
        retrySchedule.succeeded();
        assertThat(retrySchedule.isRefreshDue()).isTrue();
    }
}
