package io.furrow.provisioner;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class RetryScheduleTest {
    private static final Duration LONG = Duration.ofHours(1);

    private long now;
    private final RetrySchedule pace = new RetrySchedule(() -> now, Duration.ofSeconds(30));

    @Test
    void waitsLongerAfterEachFailureUpToTenSeconds() {
        List<Long> pauses = new ArrayList<>();
        for (int i = 0; i < 8; i++) {
            assertThat(pace.failed()).isEqualTo(i == 0);
            pauses.add(pace.pause(LONG).toMillis());
            now += pace.pause(LONG).toNanos();
        }

        assertThat(pauses).containsExactly(200L, 400L, 800L, 1600L, 3200L, 6400L, 10_000L, 10_000L);
    }

    @Test
    void hurriesForWhatIsNewButNotWhereItFails() {
        pace.rest();
        assertThat(pace.isDue()).isFalse();
        pace.hurry();
        assertThat(pace.isDue()).isTrue();

        pace.failed();
        pace.hurry();
        assertThat(pace.isDue()).isFalse();
    }

    @Test
    void looksAgainOnceAfterAFailureOrARest() {
        assertThat(pace.looksAgain()).isFalse();
        pace.failed();
        assertThat(pace.looksAgain()).isTrue();
        pace.goOn();
        assertThat(pace.looksAgain()).isFalse();
        pace.rest();
        assertThat(pace.looksAgain()).isTrue();
    }
}
