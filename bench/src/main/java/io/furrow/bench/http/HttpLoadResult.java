package io.furrow.bench.http;

import java.util.BitSet;

import org.HdrHistogram.Histogram;

/**
 * What became of a load.
 *
 * @param acknowledged the numbers, counted from {@code firstNumber}, of the notifications that were answered 2xx
 * @param refused requests that were answered otherwise
 * @param broken requests whose connection failed before the answer
 * @param latency microseconds from when a request was due to its answer, of those answered 2xx
 * @param nanos from the first request to the last answer
 */
public record HttpLoadResult(
        long firstNumber, BitSet acknowledged, long refused, long broken, Histogram latency, long nanos) {
    /** Notifications that were answered 2xx. */
    public long answered() {
        return latency.getTotalCount();
    }

    public double perSecond() {
        return answered() * 1e9 / nanos;
    }

    public double millis(double percentile) {
        return latency.getValueAtPercentile(percentile) / 1000.0;
    }
}
