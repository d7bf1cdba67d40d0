package io.furrow.connect.source;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.Map;

/**
 * A record for Kafka.
 *
 * @param key null where there is none
 * @param value null for the deletion of what the key names
 * @param headers text, in the order in which they are written
 */
record OutgoingRecord(String topic, String key, byte[] value, Instant time, Map<String, String> headers) {
    private static final int RECORD_OVERHEAD = 100;
    private static final int HEADER_OVERHEAD = 10;

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
