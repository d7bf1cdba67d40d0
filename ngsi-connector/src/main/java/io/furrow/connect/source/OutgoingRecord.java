package io.furrow.connect.source;

import java.time.Instant;
import java.util.Map;

import org.apache.kafka.common.utils.Utils;

import io.furrow.connect.repair.EntityVersion;

/**
 * A record for Kafka.
 *
 * @param key null where there is none
 * @param value null for the deletion of what the key names
 * @param headers text, in the order in which they are written
 * @param version which state of an entity it tells; null where it tells none. No part of the record
 */
record OutgoingRecord(
        String topic, String key, byte[] value, Instant time, Map<String, String> headers, EntityVersion version) {
    private static final int RECORD_OVERHEAD = 100;
    private static final int HEADER_OVERHEAD = 10;

    OutgoingRecord(String topic, String key, byte[] value, Instant time, Map<String, String> headers) {
        this(topic, key, value, time, headers, null);
    }

    /** The size that counts against a producer's {@code max.request.size}, at least. */
    long bytes() {
        long bytes = RECORD_OVERHEAD + (value == null ? 0 : value.length) + (key == null ? 0 : Utils.utf8Length(key));
        for (Map.Entry<String, String> header : headers.entrySet()) {
            bytes += HEADER_OVERHEAD + Utils.utf8Length(header.getKey()) + Utils.utf8Length(header.getValue());
        }
        return bytes;
    }
}
