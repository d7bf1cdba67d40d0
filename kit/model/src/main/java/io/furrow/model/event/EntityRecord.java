package io.furrow.model.event;

import java.time.Instant;
import java.util.Map;

/**
 * A record of one entity of a notification, wherever it is written.
 *
 * @param key id of the entity
 * @param value the entity in normalized JSON; null if it was deleted
 * @param time of the event, the record's timestamp
 * @param fault what is wrong with the time that the device gives; null if nothing is
 */
public record EntityRecord(
        String key, byte[] value, Instant time, Map<String, String> headers, EventTime.Fault fault) {}
