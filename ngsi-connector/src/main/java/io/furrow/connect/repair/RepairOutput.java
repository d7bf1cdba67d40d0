package io.furrow.connect.repair;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

/** Where findings become records. */
public interface RepairOutput {
    /**
     * Takes all findings or none; quick.
     *
     * @param subscription id of the one that should have told of them
     * @return completed when they are durable, failed if that will not be known any more; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> emit(String subscription, List<Finding> findings);
}
