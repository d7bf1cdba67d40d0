package io.furrow.launcher.replay;

import io.furrow.cli.control.ReplayAnalyticsJob;

/**
 * The progress of a job in its input.
 *
 * @param read sum of its committed offsets in all partitions
 * @param end sum of the end offsets
 */
record JobProgress(long read, long end) {
    boolean isCaughtUp() {
        return read >= end;
    }

    /** Provides the progress of jobs. */
    interface Source {
        /** @return null if the input does not exist */
        JobProgress of(ReplayAnalyticsJob job) throws AnalyticsException;
    }
}
