package io.furrow.cli.compare;

import io.furrow.cli.compare.AnalyticsResult.Average;

/**
 * The range of results to compare, by original event time.
 *
 * @param from epoch ms
 * @param to epoch ms, exclusive
 */
record TimeRange(long from, long to) {
    /** Without limits. */
    static final TimeRange ALL = new TimeRange(Long.MIN_VALUE, Long.MAX_VALUE);

    boolean overlaps(AnalyticsResult span) {
        return span.start() < to && (span.end() >= from || span.isOpen());
    }

    /** Whether it contains the whole window; part of a window has other readings. */
    boolean contains(Average window) {
        return window.start() >= from && window.end() <= to;
    }

    long start(AnalyticsResult span) {
        return Math.max(span.start(), from);
    }

    long end(AnalyticsResult span) {
        return Math.min(span.end(), to);
    }
}
