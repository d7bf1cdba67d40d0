package io.furrow.connect.record;

import java.time.Instant;
import java.util.Map;

import org.apache.kafka.common.utils.Utils;

import io.furrow.connect.repair.EntityVersion;

/**
 * A record for Kafka.
 *
 * @param key null if there is none
 * @param value null for a tombstone, which deletes the entity of the key
 * @param headers text, in order
 * @param version the state of the entity in the record; null if there is none. Not written to Kafka
 */
public record KafkaRecord(
        String topic, String key, byte[] value, Instant time, Map<String, String> headers, EntityVersion version) {
    private static final int RECORD_OVERHEAD = 100;
    private static final int HEADER_OVERHEAD = 10;

    public KafkaRecord(String topic, String key, byte[] value, Instant time, Map<String, String> headers) {
        this(topic, key, value, time, headers, null);
    }

    /** Lower bound of the size that counts against a producer's {@code max.request.size}. */
    public long bytes() {
        long bytes = RECORD_OVERHEAD + (value == null ? 0 : value.length) + (key == null ? 0 : Utils.utf8Length(key));
        for (Map.Entry<String, String> header : headers.entrySet()) {
            bytes += HEADER_OVERHEAD + Utils.utf8Length(header.getKey()) + Utils.utf8Length(header.getValue());
        }
        return bytes;
    }
}
