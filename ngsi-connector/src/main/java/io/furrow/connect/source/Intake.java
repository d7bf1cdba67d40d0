package io.furrow.connect.source;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

/** Takes the records of notifications and says when they are durable. */
interface Intake {
    /**
     * Takes all records or none.
     *
     * @return completed when every record is durable; failed with {@link NoRoomException} if there turned out to be none, with
     *     {@link ClosedException} if durability will not be known any more; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records);

    /** There was no room after all; nothing was taken. The same records may be tried again. */
    final class NoRoomException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        NoRoomException() {
            super("the disk is full", null, false, false);
        }
    }

    /** The intake was closed, or its disk failed, before the records were known to be durable. */
    final class ClosedException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        ClosedException() {
            super("the source is stopping");
        }

        ClosedException(Throwable cause) {
            super(cause.getMessage(), cause, false, false);
        }
    }
}
