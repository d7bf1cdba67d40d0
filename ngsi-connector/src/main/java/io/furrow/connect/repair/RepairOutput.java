package io.furrow.connect.repair;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;

/** Converts findings into records and appends them. */
public interface RepairOutput {
    /**
     * Serializes the record of a finding for {@link #append}.
     *
     * @param subscription id of the subscription that should have notified it
     */
    byte[] serialize(String subscription, MissedChange finding);

    /**
     * Appends all records or none; does not block.
     *
     * @return completed when they are durable, failed if that will not be known; empty if there is no room now
     */
    Optional<CompletableFuture<Void>> append(List<byte[]> records);
}
