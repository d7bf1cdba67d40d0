package io.furrow.connect.source;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Map;

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
        long bytes = RECORD_OVERHEAD + (value == null ? 0 : value.length) + (key == null ? 0 : utf8(key));
        for (Map.Entry<String, String> header : headers.entrySet()) {
            bytes += HEADER_OVERHEAD + utf8(header.getKey()) + utf8(header.getValue());
        }
        return bytes;
    }

    private static int utf8(String text) {
        return text.getBytes(StandardCharsets.UTF_8).length;
    }
}
