package io.furrow.bench.control;

import java.util.concurrent.CompletableFuture;

/** Sends requests to the managers. */
interface ControlClient extends AutoCloseable {
    /** The status of the answer. @param id of the request, unique */
    CompletableFuture<String> ask(ControlRequest request, String id);

    /** Number of repeated answers. */
    default long repeats() {
        return 0;
    }

    @Override
    default void close() {}
}
