package io.furrow.bench.replay;

import java.util.List;
import java.util.stream.LongStream;

import org.junit.jupiter.api.Test;

import io.furrow.bench.replay.Lateness.Late;

import static org.assertj.core.api.Assertions.assertThat;

class LatenessTest {
    /** A hundred events, the first tenth by 0 ms late, the next by 1 ms, the last by 9 ms. */
    private static List<Late> growing() {
        return LongStream.range(0, 100)
                .mapToObj(i -> new Late(1_000 * i, 1_000 * i + i / 10))
                .toList();
    }

    @Test
    void saysByHowMuchTheLastTenthIsLaterThanTheFirst() {
        assertThat(Lateness.of(growing())).isEqualTo(new Lateness(5, 9, 9, 9, 0));
    }

    @Test
    void showsAnEventThatIsEarly() {
        assertThat(Lateness.of(List.of(new Late(10, 8), new Late(20, 21))).least())
                .isEqualTo(-2);
    }

    @Test
    void takesEachFigureOfSeveralTurnsByItself() {
        Lateness median = Lateness.median(
                List.of(new Lateness(1, 9, 30, 0, 0), new Lateness(3, 7, 20, -1, -1), new Lateness(2, 8, 10, 1, 0)));

        assertThat(median).isEqualTo(new Lateness(2, 8, 20, 0, 0));
    }
}
