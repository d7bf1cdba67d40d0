package io.furrow.model.event;

import java.time.Instant;
import java.util.Map;

/**
 * A record of one entity of a notification, wherever it is written.
 *
 * @param key id of the entity
 * @param value the entity in normalized JSON; null if it was deleted
 * @param time of the event, the record's timestamp
 * @param clockAhead whether the reported time was too far ahead, so that {@code time} is that of the receipt
 */
public record EntityRecord(String key, byte[] value, Instant time, Map<String, String> headers, boolean clockAhead) {}
