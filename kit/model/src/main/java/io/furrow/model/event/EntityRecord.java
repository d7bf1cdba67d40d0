package io.furrow.model.event;

import java.time.Instant;
import java.util.Map;

/**
 * A record of one entity of a notification.
 *
 * @param key id of the entity
 * @param value the entity in normalized JSON; null if it was deleted
 * @param time event time, the record's timestamp
 * @param fault what is wrong with the device's time; null if nothing is
 */
public record EntityRecord(
        String key, byte[] value, Instant time, Map<String, String> headers, EventTime.Fault fault) {}
