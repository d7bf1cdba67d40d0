package io.furrow.bench.load;

import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class ArrivalsTest {
    @Test
    void countsWhereMessagesWereInEachSecondAndHowLongEachHopTook() {
        List<Arrivals.Passage> passages = List.of(
                new Arrivals.Passage(10_000, 10_010, 10_030, 10_060),
                new Arrivals.Passage(10_900, 10_920, 11_000, 11_010));

        assertThat(Arrivals.seconds(passages))
                .containsExactly(
                        new LoadSecond(0, 2, 2, 1, 1, List.of(15.0, 50.0, 20.0)),
                        new LoadSecond(1, 0, 0, 1, 1, List.of()));
    }
}
