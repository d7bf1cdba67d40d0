package io.furrow.analytics.temperature;

import io.furrow.flink.TopicRecord;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Position;

/**
 * What one device measured at one place; its event time is the timestamp of the record.
 *
 * @param device entity id
 * @param value in the attribute's unit, finite
 * @param eventId equal for every copy of the same event
 * @param record as it was read, for the topic of late readings
 */
public record Reading(
        String device, FiwareScope scope, Position position, double value, String eventId, TopicRecord record) {
    /** The topic that told of it, and the tenant. */
    InputScope input() {
        return new InputScope(record.topic(), scope);
    }

    /** The device among those of all topics and tenants. */
    public String deviceIdentity() {
        return input().identity(device);
    }
}
