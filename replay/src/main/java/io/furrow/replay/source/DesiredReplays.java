package io.furrow.replay.source;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.locks.LockSupport;

import io.furrow.model.control.ReplayStatus;

/** Source of the desired replays. Serializable, so that a job can carry it. */
public interface DesiredReplays extends Serializable {
    /** Returns whether the desired replays are fixed from the start. */
    boolean isBounded();

    /** Begins to read from the beginning. */
    Reading open();

    /**
     * A change of a replay's desired state.
     *
     * @param desired value of its record; null if it was removed
     */
    record ReplayUpdate(String replay, byte[] desired) {}

    /** The newest status of a replay before the job started. */
    record ReportedStatus(String replay, ReplayStatus status) {}

    /**
     * Reads desired replays; used by one thread at a time. A method that throws an {@link IOException} is called again.
     */
    interface Reading extends AutoCloseable {
        /** Returns the reported statuses; called until it succeeds. */
        List<ReportedStatus> reportedStatuses() throws IOException;

        /** Returns the changes since the last call; waits a moment if there are none. */
        List<ReplayUpdate> poll() throws IOException;

        /** Returns whether all records that existed at the beginning were returned. */
        boolean isCaughtUp() throws IOException;

        /** Ends a call in progress. Thread-safe. */
        @Override
        void close();
    }

    /** A single desired replay. */
    record One(String replay, byte[] desired) implements DesiredReplays {
        private static final Duration IDLE = Duration.ofMillis(500);

        @Override
        public boolean isBounded() {
            return true;
        }

        @Override
        public Reading open() {
            return new Reading() {
                private boolean read;

                @Override
                public List<ReportedStatus> reportedStatuses() {
                    return List.of();
                }

                @Override
                public List<ReplayUpdate> poll() {
                    if (read) {
                        LockSupport.parkNanos(IDLE.toNanos());
                        return List.of();
                    }
                    read = true;
                    return List.of(new ReplayUpdate(replay, desired));
                }

                @Override
                public boolean isCaughtUp() {
                    return read;
                }

                @Override
                public void close() {
                    // no resources
                }
            };
        }
    }
}
