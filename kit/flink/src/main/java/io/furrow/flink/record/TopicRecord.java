package io.furrow.flink.record;

import java.nio.charset.StandardCharsets;
import java.util.Map;

import org.apache.flink.api.common.typeinfo.TypeInfo;

/**
 * A record read from, or to be written to, a Kafka topic.
 *
 * @param partition −1 like {@code offset} if the record was not read from a topic; a partition without an offset is the target
 *     partition, otherwise the key decides
 * @param timestamp event time, epoch ms
 * @param key null if there is none
 * @param value null for a deletion
 * @param headers UTF-8 text; of a repeated header the last
 */
@TypeInfo(TopicRecordSerializer.class)
public record TopicRecord(
        String topic,
        int partition,
        long offset,
        long timestamp,
        byte[] key,
        byte[] value,
        Map<String, String> headers) {
    private static final int NOWHERE = -1;

    /** A record to be written. */
    public static TopicRecord of(String topic, long timestamp, String key, byte[] value, Map<String, String> headers) {
        return new TopicRecord(
                topic, NOWHERE, NOWHERE, timestamp, key.getBytes(StandardCharsets.UTF_8), value, headers);
    }

    /** The same record for another topic. */
    public TopicRecord to(String other) {
        return new TopicRecord(other, partition, offset, timestamp, key, value, headers);
    }

    /** The same record for one partition of its topic, whatever its key. */
    public TopicRecord toPartition(int one) {
        return new TopicRecord(topic, one, NOWHERE, timestamp, key, value, headers);
    }

    /** The same record with another value. */
    public TopicRecord withValue(byte[] other) {
        return new TopicRecord(topic, partition, offset, timestamp, key, other, headers);
    }

    /** The same record with another event time. */
    public TopicRecord at(long time) {
        return new TopicRecord(topic, partition, offset, time, key, value, headers);
    }

    /** The same record with an additional header. */
    public TopicRecord with(String header, String text) {
        return with(Map.of(header, text));
    }

    /** The same record with more headers. */
    public TopicRecord with(Map<String, String> more) {
        return new TopicRecord(
                topic,
                partition,
                offset,
                timestamp,
                key,
                value,
                TextHeaders.of(headers).with(more));
    }

    /** {@code <topic>-<partition>@<offset>}. */
    public String position() {
        return topic + "-" + partition + "@" + offset;
    }
}
