package io.furrow.connect.source.notification;

import java.util.List;
import java.util.Optional;

import io.furrow.connect.record.KafkaRecord;
import io.furrow.model.ngsi.Reason;

/**
 * The result of translating a notification.
 *
 * @param records entities and dead letters; all must be durable before the sender is answered
 * @param refusal the reason for an error answer; empty if any part of the notification could be used
 */
public record Translation(List<KafkaRecord> records, Optional<Refusal> refusal) {
    /** The reason why a whole notification was rejected. */
    public record Refusal(Reason reason, String message) {}
}
