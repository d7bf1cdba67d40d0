package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndTimestamp;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads the records of a topic in a period, by their timestamps. Beyond its limits it leaves out the oldest records and
 * reports the time since which the result is complete.
 */
public record TopicHistory(Properties client, Limits limits, int valueBytes) {
    private static final Duration POLL = Duration.ofMillis(200);
    /** Records are not strictly in the order of their timestamps. */
    private static final long DISORDER_MS = 60_000;

    /**
     * Limits of one request.
     *
     * @param scanned number of records read
     * @param answered bytes of values returned
     * @param time for reading
     */
    public record Limits(long scanned, long answered, Duration time) {
        public static final Limits DEFAULT = new Limits(300_000, 8L * 1024 * 1024, Duration.ofSeconds(10));
    }

    /**
     * A request.
     *
     * @param from epoch ms
     * @param to epoch ms, exclusive
     * @param newest name of an attribute or other member: of records with the same tenant, service path, type and value
     *     of it, only the last is returned; null for all records
     * @param limit number of records returned
     */
    public record Range(String topic, long from, long to, String newest, int limit) {}

    /**
     * The records found.
     *
     * @param records in the order of their offsets within each partition; partitions are interleaved
     * @param since epoch ms since which no record is missing; {@code from} if all are there
     */
    public record Answer(List<FeedRecord> records, long since) {}

    public Answer read(Range range) {
        try (KafkaConsumer<byte[], byte[]> consumer = new KafkaConsumer<>(
                CommittedReader.boundedSettings(client), new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            return new Reading(range, consumer).read();
        }
    }

    private record Position(long time, int partition, long offset) {
        static Position of(ConsumerRecord<?, ?> record) {
            return new Position(record.timestamp(), record.partition(), record.offset());
        }
    }

    /** Processes one request. */
    private final class Reading {
        private final Range range;
        private final KafkaConsumer<byte[], byte[]> consumer;
        private final LinkedHashMap<String, ConsumerRecord<byte[], byte[]>> retained = new LinkedHashMap<>();
        /** The ids of retained records, the oldest first: partitions are read one after the other. */
        private final TreeMap<Position, String> byTime = new TreeMap<>(Comparator.comparingLong(Position::time)
                .thenComparingInt(Position::partition)
                .thenComparingLong(Position::offset));

        private final Map<TopicPartition, Long> starts = new HashMap<>();
        private final Map<TopicPartition, Long> ends = new HashMap<>();
        /** Partitions whose oldest records of the period were deleted, or are not read. */
        private final Map<TopicPartition, Boolean> cutOff = new HashMap<>();

        private long bytes;
        private long since;

        Reading(Range range, KafkaConsumer<byte[], byte[]> consumer) {
            this.range = range;
            this.consumer = consumer;
            this.since = range.from();
        }

        Answer read() {
            assignRanges();
            starts.forEach(consumer::seek);
            long deadline = System.nanoTime() + limits.time().toNanos();
            while (starts.keySet().stream().anyMatch(each -> consumer.position(each) < ends.get(each))) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    add(record);
                }
                if (System.nanoTime() > deadline) {
                    since = range.to();
                    break;
                }
            }
            List<FeedRecord> records = new ArrayList<>(retained.size());
            retained.values().forEach(each -> records.add(new FeedRecord(each, FeedRecord.NO_SEQUENCE, valueBytes)));
            return new Answer(records, since);
        }

        /** Determines the range of offsets of each partition. */
        private void assignRanges() {
            List<TopicPartition> all = consumer.partitionsFor(range.topic()).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            consumer.assign(all);
            Map<TopicPartition, Long> lastOffsets = consumer.endOffsets(all);
            Map<TopicPartition, Long> firstOffsets = consumer.beginningOffsets(all);
            Map<TopicPartition, OffsetAndTimestamp> from = consumer.offsetsForTimes(times(all, range.from()));
            Map<TopicPartition, OffsetAndTimestamp> to =
                    consumer.offsetsForTimes(times(all, Math.addExact(range.to(), DISORDER_MS)));
            long share = limits.scanned() / Math.max(1, all.size());
            for (TopicPartition each : all) {
                boolean toEnd = to.get(each) == null;
                long end = toEnd ? lastOffsets.get(each) : to.get(each).offset();
                // no more than the limit can be returned of a period that lasts to the end
                long maximum = toEnd && range.newest() == null ? Math.min(share, range.limit()) : share;
                long start = from.get(each) == null
                        ? end
                        : Math.min(end, from.get(each).offset());
                ends.put(each, end);
                starts.put(each, Math.max(start, end - maximum));
                cutOff.put(each, start < end - maximum || start < end && start == firstOffsets.get(each) && start > 0);
            }
        }

        private static Map<TopicPartition, Long> times(List<TopicPartition> partitions, long time) {
            Map<TopicPartition, Long> times = new HashMap<>();
            partitions.forEach(each -> times.put(each, Math.max(0, time)));
            return times;
        }

        private void add(ConsumerRecord<byte[], byte[]> record) {
            TopicPartition partition = new TopicPartition(record.topic(), record.partition());
            if (record.offset() >= ends.get(partition)) {
                return;
            }
            if (Boolean.TRUE.equals(cutOff.put(partition, false))) {
                since = Math.max(since, record.timestamp());
            }
            if (record.timestamp() < range.from()
                    || record.timestamp() >= range.to()
                    || record.value() == null && range.newest() != null) {
                return;
            }
            String id = id(record);
            ConsumerRecord<byte[], byte[]> older = retained.remove(id);
            if (older != null) {
                bytes -= length(older);
                byTime.remove(Position.of(older));
            }
            retained.put(id, record);
            byTime.put(Position.of(record), id);
            bytes += length(record);
            while (retained.size() > range.limit() || bytes > limits.answered() && retained.size() > 1) {
                ConsumerRecord<byte[], byte[]> oldest =
                        retained.remove(byTime.pollFirstEntry().getValue());
                bytes -= length(oldest);
                since = Math.max(since, oldest.timestamp() + 1);
            }
        }

        /** The length of the value; 0 for a deletion. */
        private static int length(ConsumerRecord<byte[], byte[]> record) {
            return record.value() == null ? 0 : record.value().length;
        }

        private String id(ConsumerRecord<byte[], byte[]> record) {
            String position = record.partition() + "/" + record.offset();
            if (range.newest() == null || record.value().length > valueBytes) {
                return position;
            }
            try {
                JsonNode read = NgsiJson.read(record.value());
                JsonNode member = read.path(range.newest());
                JsonNode value = member.isObject() ? member.path("value") : member;
                return value.isValueNode() && !value.asText().isEmpty()
                        ? "="
                                + KafkaClients.scope(record.headers())
                                        .identity(read.path("type").asText(""), value.asText())
                        : position;
            } catch (UnreadableException e) {
                return position;
            }
        }
    }
}
