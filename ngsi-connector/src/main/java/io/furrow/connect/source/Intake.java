package io.furrow.connect.source;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

/** Takes the records of notifications and says when they are durable. */
interface Intake {
    /**
     * Takes all records or none.
     *
     * @return completed when every record is durable, failed with {@link ClosedException} if that will not be known any
     *     more; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> take(List<OutgoingRecord> records);

    /** The intake was closed before the records were known to be durable. */
    final class ClosedException extends RuntimeException {
        private static final long serialVersionUID = 1L;

        ClosedException() {
            super("the source is stopping");
        }
    }
}
