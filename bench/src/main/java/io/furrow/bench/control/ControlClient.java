package io.furrow.bench.control;

import java.util.concurrent.CompletableFuture;

/** Asks the managers. */
interface ControlClient extends AutoCloseable {
    /** The status of the answer. @param id of the request, which is given once */
    CompletableFuture<String> ask(ControlRequest request, String id);

    /** Answers to ids that had been answered. */
    default long repeats() {
        return 0;
    }

    @Override
    default void close() {}
}
