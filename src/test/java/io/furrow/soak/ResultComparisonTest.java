package io.furrow.soak;

import java.util.List;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;

class ResultComparisonTest {
    private static final Result FIRST = new Result("number 1", "a", 10);
    private static final Result SECOND = new Result("number 2", "b", 20);

    @Test
    void isCleanIfEachResultIsThereOnce() {
        assertThat(ResultComparison.of(List.of(FIRST, SECOND), List.of(SECOND, FIRST), 20)
                        .isClean())
                .isTrue();
    }

    @Test
    void listsMissingResults() {
        ResultComparison comparison = ResultComparison.of(List.of(FIRST, SECOND), List.of(SECOND), 20);

        assertThat(comparison.missing()).containsExactly("number 1");
        assertThat(comparison.isClean()).isFalse();
    }

    @Test
    void listsRepeatedResults() {
        ResultComparison comparison = ResultComparison.of(List.of(FIRST), List.of(FIRST, FIRST), 20);

        assertThat(comparison.repeated()).containsExactly("number 1");
        assertThat(comparison.isClean()).isFalse();
    }

    @Test
    void listsWrongValues() {
        ResultComparison comparison = ResultComparison.of(List.of(FIRST), List.of(new Result("number 1", "c", 10)), 20);

        assertThat(comparison.wrong()).containsExactly("number 1 is c instead of a");
        assertThat(comparison.isClean()).isFalse();
    }

    @Test
    void treatsResultsAfterTheHorizonAsOptional() {
        assertThat(ResultComparison.of(List.of(FIRST, SECOND), List.of(FIRST), 10)
                        .isClean())
                .isTrue();
        assertThat(ResultComparison.of(List.of(FIRST, SECOND), List.of(FIRST, SECOND), 10)
                        .isClean())
                .isTrue();
    }

    @Test
    void isNotCleanIfNothingWasRequired() {
        assertThat(ResultComparison.of(List.of(), List.of(), 20).isClean()).isFalse();
    }
}
