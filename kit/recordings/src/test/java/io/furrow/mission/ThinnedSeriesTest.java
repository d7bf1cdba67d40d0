package io.furrow.mission;

import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ThinnedSeriesTest {
    private static final long TIME = 1_700_000_000_000L;
    private static final long WEEK = 7 * 86_400_000L;

    private static ThinnedSeries.Point point(long after, double value) {
        return new ThinnedSeries.Point(TIME + after, value);
    }

    @Test
    void retainsFewPointsInTheOrderOfTheirTimes() {
        ThinnedSeries series = new ThinnedSeries(TIME, TIME + 100, 10);
        for (int i = 9; i >= 0; i--) {
            series.add(TIME + i, -i);
        }

        assertThat(series.points())
                .hasSize(10)
                .startsWith(point(0, 0), point(1, -1))
                .endsWith(point(9, -9));
        assertThat(series.partMillis()).isZero();
        series.add(TIME + 99, 5);
        assertThat(series.points()).containsExactly(point(0, 0), point(9, -9), point(99, 5));
        assertThat(series.partMillis()).isEqualTo(25);
        assertThat(series.count()).isEqualTo(11);
    }

    /** A week of a device that reports twice a second; one value in it is high, another low, each only once. */
    @ParameterizedTest
    @ValueSource(booleans = {false, true})
    void losesNoPeakOfAWeek(boolean backwards) {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        int values = 1_209_600;
        int[] peaks = {random.nextInt(values), random.nextInt(values)};
        ThinnedSeries series = new ThinnedSeries(TIME, TIME + WEEK, 2_000);
        for (int n = 0; n < values; n++) {
            int i = backwards ? values - 1 - n : n;
            double value = i == peaks[0] ? 99 : i == peaks[1] ? -99 : Math.sin(i / 1e5) * 10 + random.nextDouble();
            series.add(TIME + i * 500L, value);
        }

        assertThat(series.points())
                .as("seed %d", seed)
                .hasSizeBetween(1_900, 2_000)
                .isSortedAccordingTo((one, other) -> Long.compare(one.time(), other.time()))
                .contains(point(peaks[0] * 500L, 99))
                .satisfies(points -> assertThat(points.get(0).time()).isEqualTo(TIME))
                .satisfies(points ->
                        assertThat(points.get(points.size() - 1).time()).isEqualTo(TIME + WEEK - 500));
        if (peaks[0] != peaks[1]) {
            assertThat(series.points()).as("seed %d", seed).contains(point(peaks[1] * 500L, -99));
        }
        assertThat(series.count()).isEqualTo(values);
    }

    /** The lowest and the highest value of each part of the period are those of all values in it. */
    @Test
    void hasTheExtremesOfEachPart() {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        int max = 10 + random.nextInt(90);
        ThinnedSeries series = new ThinnedSeries(TIME, TIME + 10_000, max);
        double[] values = random.doubles(10_000).toArray();
        for (int i = 0; i < values.length; i++) {
            series.add(TIME + i, values[i]);
        }

        long part = series.partMillis();
        assertThat(series.points()).as("seed %d", seed).hasSizeLessThanOrEqualTo(max);
        for (int from = 0; from < values.length; from += (int) part) {
            double highest = Double.NEGATIVE_INFINITY;
            double lowest = Double.POSITIVE_INFINITY;
            for (int i = from; i < Math.min(values.length, from + part); i++) {
                highest = Math.max(highest, values[i]);
                lowest = Math.min(lowest, values[i]);
            }
            assertThat(series.points())
                    .as("seed %d, part at %d", seed, from)
                    .extracting(ThinnedSeries.Point::value)
                    .contains(highest, lowest);
        }
    }

    @Test
    void rejectsAPeriodWithoutLength() {
        assertThatThrownBy(() -> new ThinnedSeries(TIME, TIME, 10))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("the period must have a length");
    }
}
