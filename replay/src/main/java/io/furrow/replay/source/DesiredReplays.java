package io.furrow.replay.source;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.locks.LockSupport;

import io.furrow.model.control.ReplayStatus;

/** Source of the desired replays. Serializable, so that a job can carry it. */
public interface DesiredReplays extends Serializable {
    /** Whether all that will ever be wanted is known at once. */
    boolean isBounded();

    /** Begins to read, from the beginning. */
    Reading open();

    /**
     * What is requested of a replay.
     *
     * @param desired value of its record; null if it was removed
     */
    record ReplayUpdate(String replay, byte[] desired) {}

    /**
     * What was reported of a replay before.
     *
     * @param replay its name
     */
    record ReportedStatus(String replay, ReplayStatus status) {}

    /** Used by one thread at a time. What throws an {@link IOException} cannot be read now and is called again. */
    interface Reading extends AutoCloseable {
        /** What has been notified of replays until now; called until it was read. */
        List<ReportedStatus> reportedStatuses() throws IOException;

        /** What came since the last call; waits a moment where nothing did. */
        List<ReplayUpdate> poll() throws IOException;

        /** Whether everything was returned that was there at the beginning. */
        boolean isCaughtUp() throws IOException;

        /** From any thread; ends a call that is under way. */
        @Override
        void close();
    }

    /** One replay and no other. */
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
                    // holds nothing
                }
            };
        }
    }
}
