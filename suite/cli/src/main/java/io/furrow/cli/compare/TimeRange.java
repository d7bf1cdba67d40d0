package io.furrow.cli.compare;

import io.furrow.cli.compare.AnalyticsResult.Average;

/**
 * Which results count, by original event time.
 *
 * @param from epoch ms
 * @param to epoch ms, after the last instant
 */
record TimeRange(long from, long to) {
    /** All that there is. */
    static final TimeRange ALL = new TimeRange(Long.MIN_VALUE, Long.MAX_VALUE);

    boolean overlaps(AnalyticsResult span) {
        return span.start() < to && (span.end() >= from || span.isOpen());
    }

    /** Whether a window lies within; one that is cut has other readings than a whole one. */
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
