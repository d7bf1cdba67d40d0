package io.furrow.launcher.replay;

import java.time.Duration;

/**
 * Decides when a job whose replay is over may end: a little after it has read everything, so that its last results are written, or
 * when it makes no progress. Progress is reported with each checkpoint.
 */
final class JobEnding {
    /** Longer than a checkpoint, because results are written after their input is read. */
    static final Duration SETTLING = Duration.ofSeconds(12);
    /** Without progress: longer than jobs take to start, and clusters from one checkpoint to the next. */
    static final Duration STALLED = Duration.ofMinutes(5);

    private long read = -1;
    private long since = Long.MIN_VALUE;
    private boolean caughtUp;

    /** @param now monotonic ms */
    boolean mayEnd(JobProgress progress, long now) {
        if (progress == null) {
            return true;
        }
        if (since == Long.MIN_VALUE || progress.read() != read || progress.isCaughtUp() != caughtUp) {
            read = progress.read();
            caughtUp = progress.isCaughtUp();
            since = now;
        }
        return now - since >= (caughtUp ? SETTLING : STALLED).toMillis();
    }

    boolean isCaughtUp() {
        return caughtUp;
    }
}
