package io.furrow.analytics.collision.matching;

import io.furrow.analytics.position.PositionFix;

/**
 * The state of a grid cell's crowds as last emitted.
 *
 * @param time when, epoch milliseconds
 * @param over whether a device was in a crowd then
 * @param witness a device that is, or was, in it; has its topic and scope
 */
record CrowdReport(long time, boolean over, PositionFix witness) {
    /** Between two records of a cell, in milliseconds. */
    static final long EVERY = 60_000;

    /** When there may be something to emit again. */
    long next() {
        return time + EVERY;
    }
}
