package io.furrow.cli.compare;

import java.util.Set;

/**
 * The average of a field in a window.
 *
 * @param start first instant of the window
 * @param end first instant after the window
 * @param mean NaN if nothing was reported
 * @param suspects devices that were left out
 * @param quality {@code robust} or {@code unverified}
 */
record AverageResult(ResultSubject subject, long start, long end, double mean, Set<String> suspects, String quality)
        implements AnalyticsResult {
    AverageResult {
        suspects = Set.copyOf(suspects);
    }

    @Override
    public boolean isOpen() {
        return false;
    }

    /** Whether it says that nothing was reported. */
    boolean isEmpty() {
        return Double.isNaN(mean);
    }

    @Override
    public AverageResult of(ResultSubject other) {
        return new AverageResult(other, start, end, mean, suspects, quality);
    }
}
