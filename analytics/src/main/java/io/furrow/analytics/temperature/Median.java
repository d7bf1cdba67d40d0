package io.furrow.analytics.temperature;

import java.util.Arrays;

/** The value in the middle of an odd number of values, the mean of the two in the middle of an even number. */
final class Median {
    private Median() {}

    /** @param values at least one, in any order; not modified */
    static double of(double... values) {
        if (values.length == 0) {
            throw new IllegalArgumentException("no values have no median");
        }
        double[] sorted = values.clone();
        Arrays.sort(sorted);
        int middle = sorted.length / 2;
        return sorted.length % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
    }
}
