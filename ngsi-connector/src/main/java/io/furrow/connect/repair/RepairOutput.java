package io.furrow.connect.repair;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

/** Where findings become records. */
public interface RepairOutput {
    /**
     * The record of a finding, as {@link #append} takes it.
     *
     * @param subscription id of the one that should have told of it
     */
    byte[] serialize(String subscription, Finding finding);

    /**
     * Takes all records or none; quick.
     *
     * @return completed when they are durable, failed if that will not be known any more; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> append(List<byte[]> records);
}
