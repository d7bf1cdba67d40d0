package io.furrow.analytics.temperature;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.Position;

/**
 * A measurement of one device at one place; the element's timestamp is its event time.
 *
 * @param device entity id
 * @param type of the entity
 * @param value in the attribute's unit, finite
 * @param eventId equal for every copy of the same event
 * @param record the input record, for the topic of late readings; an excerpt if it is large
 */
public record Reading(
        String device,
        String type,
        FiwareScope scope,
        Position position,
        double value,
        String eventId,
        TopicRecord record) {
    /** Its topic and tenant. */
    InputScope input() {
        return new InputScope(record.topic(), scope);
    }

    /** Original event time, epoch ms. */
    long time() {
        try {
            return Epochs.originalTimeOf(record);
        } catch (UnreadableException e) {
            throw new IllegalStateException("a reading was made of a record without a time", e);
        }
    }

    /** The device, unique across topics, tenants and types. */
    String deviceIdentity() {
        return input().identity(type, device);
    }
}
