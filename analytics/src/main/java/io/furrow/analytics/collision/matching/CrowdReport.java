package io.furrow.analytics.collision.matching;

import io.furrow.analytics.position.PositionFix;

/**
 * The last emitted state of a grid cell's crowds.
 *
 * @param time epoch milliseconds
 * @param over whether a device was in a crowd then
 * @param witness a device that is, or was, in it; has its topic and scope
 */
record CrowdReport(long time, boolean over, PositionFix witness) {
    /** Milliseconds between two records of a cell. */
    static final long EVERY = 60_000;

    /** When the next record may be due. */
    long next() {
        return time + EVERY;
    }
}
