package io.furrow.launcher.status;

import java.util.Map;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class RatesTest {
    private final Rates rates = new Rates();

    @Test
    void dividesWhatCameByTheTimeBetweenTwoPolls() {
        rates.next(Map.of("a", 100L), 0);

        assertThat(rates.next(Map.of("a", 150L), TimeUnit.SECONDS.toNanos(2))).containsEntry("a", 25.0);
    }

    @Test
    void isOfTheLastTenSecondsSoThatASlowTopicStaysInSight() {
        for (int second = 0; second <= 12; second++) {
            rates.next(Map.of("a", second < 5 ? 0L : 4L), TimeUnit.SECONDS.toNanos(second));
        }

        assertThat(rates.next(Map.of("a", 4L), TimeUnit.SECONDS.toNanos(14))).containsEntry("a", 0.4);
        assertThat(rates.next(Map.of("a", 4L), TimeUnit.SECONDS.toNanos(30))).containsEntry("a", 0.0);
    }

    @Test
    void startsAtZeroForATopicSeenForTheFirstTime() {
        rates.next(Map.of("a", 100L), 0);

        assertThat(rates.next(Map.of("a", 100L, "b", 7L), TimeUnit.SECONDS.toNanos(1)))
                .containsAllEntriesOf(Map.of("a", 0.0, "b", 0.0));
    }
}
