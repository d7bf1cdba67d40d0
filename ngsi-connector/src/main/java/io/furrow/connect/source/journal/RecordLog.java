package io.furrow.connect.source.journal;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

import io.furrow.connect.record.KafkaRecord;

/** Accepts the records of notifications and reports when they are durable. */
public interface RecordLog {
    /**
     * Appends all records or none.
     *
     * @return completed when every record is durable; failed with {@link NoRoomException} if the disk was full,
     *     with {@link ClosedException} if durability will no longer be known; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> take(List<KafkaRecord> records);

    /** The disk was full and nothing was appended. The same records may be appended again. */
    final class NoRoomException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        NoRoomException() {
            super("the disk is full", null, false, false);
        }
    }

    /** The intake was closed, or its disk failed, before the records were known to be durable. */
    final class ClosedException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        public ClosedException() {
            super("the source is stopping");
        }

        ClosedException(Throwable cause) {
            super(cause.getMessage(), cause, false, false);
        }
    }
}
