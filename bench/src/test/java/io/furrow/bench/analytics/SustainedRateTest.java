package io.furrow.bench.analytics;

import java.util.List;
import java.util.stream.LongStream;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class SustainedRateTest {
    @Test
    void holdsWhereTheLagSwingsWithTheCheckpoints() {
        SustainedRate held = rate(1000, 1, lags(0, 700));
        assertThat(held.slope()).isCloseTo(0, within(10.0));
        assertThat(held.isHeld()).isTrue();
    }

    @Test
    void doesNotHoldWhereTheLagGrows() {
        SustainedRate grown = rate(1000, 1, lags(20, 700));
        assertThat(grown.slope()).isCloseTo(20, within(10.0));
        assertThat(grown.isHeld()).isFalse();
    }

    @Test
    void doesNotHoldWhereTheFleetSentLess() {
        assertThat(rate(950, 1, lags(0, 0)).isHeld()).isFalse();
    }

    private static SustainedRate rate(double sent, double found, List<Long> lags) {
        return new SustainedRate(new SustainedRate.Plan(1000, 2000, 1, "10s"), sent, found, lags);
    }

    private static List<Long> lags(long growth, long swing) {
        return LongStream.range(0, 60)
                .mapToObj(second -> 500 + growth * second + second % 10 * swing / 9)
                .toList();
    }
}
