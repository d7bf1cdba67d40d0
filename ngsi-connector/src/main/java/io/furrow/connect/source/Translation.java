package io.furrow.connect.source;

import java.util.List;
import java.util.Optional;

import io.furrow.model.ngsi.Reason;

/**
 * What a notification becomes.
 *
 * @param records entities and dead letters; all must be durable before the sender has its answer
 * @param refusal why the sender is told that its request is wrong; empty if anything in it could be used
 */
record Translation(List<OutgoingRecord> records, Optional<Refusal> refusal) {
    /** Why a whole notification was set aside. */
    record Refusal(Reason reason, String message) {}
}
