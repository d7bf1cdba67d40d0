package io.furrow.analytics.collision;

/**
 * What was last told of the crowds of a grid cell.
 *
 * @param time when, epoch milliseconds
 * @param over whether a device was in a crowd then
 * @param witness a device that is, or was, in it; tells topic and scope
 */
record CrowdReport(long time, boolean over, PositionFix witness) {
    /** Between two records of a cell, in milliseconds. */
    static final long EVERY = 60_000;

    /** When there may be something to tell again. */
    long next() {
        return time + EVERY;
    }
}
