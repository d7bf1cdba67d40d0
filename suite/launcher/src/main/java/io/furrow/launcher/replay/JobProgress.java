package io.furrow.launcher.replay;

import io.furrow.cli.control.ReplayAnalyticsJob;

/**
 * How far a job has read its input.
 *
 * @param read offsets that it has committed, of all partitions together
 * @param end of the input
 */
record JobProgress(long read, long end) {
    boolean isCaughtUp() {
        return read >= end;
    }

    /** Reports jobs. */
    interface Source {
        /** @return null if the input is not there */
        JobProgress of(ReplayAnalyticsJob job) throws AnalyticsException;
    }
}
