package io.furrow.analytics.temperature;

import io.furrow.flink.record.Epochs;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.position.Position;

/**
 * What one device measured at one place; the element's timestamp is its event time.
 *
 * @param device entity id
 * @param type of the entity
 * @param value in the attribute's unit, finite
 * @param eventId equal for every copy of the same event
 * @param record as it was read, for the topic of late readings; of a large one what the job read of it
 */
public record Reading(
        String device,
        String type,
        FiwareScope scope,
        Position position,
        double value,
        String eventId,
        TopicRecord record) {
    /** The topic that it is from, and the tenant. */
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

    /** The device among those of all topics and tenants, whatever its type. */
    String deviceIdentity() {
        return input().identity(device);
    }
}
