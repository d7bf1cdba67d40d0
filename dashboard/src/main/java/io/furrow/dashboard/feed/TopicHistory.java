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

import io.furrow.kafka.KafkaClients;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Reads what a topic holds of a stretch of time, by the timestamps of its records. Of more than it may read or answer it leaves out the
 * oldest, and says since when the answer is whole.
 */
public record TopicHistory(Properties client, Limits limits, int valueBytes) {
    private static final Duration POLL = Duration.ofMillis(200);
    /** Records are not strictly in the order of their timestamps. */
    private static final long DISORDER_MS = 60_000;

    /**
     * Of one answer.
     *
     * @param scanned records that are read
     * @param answered bytes of values
     * @param time that reading may take
     */
    public record Limits(long scanned, long answered, Duration time) {
        public static final Limits DEFAULT = new Limits(300_000, 8L * 1024 * 1024, Duration.ofSeconds(10));
    }

    /**
     * What is asked for.
     *
     * @param from epoch ms
     * @param to epoch ms, exclusive
     * @param newest an attribute, or a member that is not an attribute: of records of a tenant, service path and type with the same value of it only the last comes; null for all records
     * @param limit how many records at most
     */
    public record Range(String topic, long from, long to, String newest, int limit) {}

    /**
     * @param records in the order in which they were written, partition by partition mixed
     * @param since epoch ms from which on nothing was left out; {@code from} where all is there
     */
    public record Answer(List<FeedRecord> records, long since) {}

    public Answer read(Range range) {
        try (KafkaConsumer<byte[], byte[]> consumer = new KafkaConsumer<>(
                TopicFeed.settings(client), new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            return new Reading(range, consumer).read();
        }
    }

    private record Place(long time, int partition, long offset) {
        static Place of(ConsumerRecord<?, ?> record) {
            return new Place(record.timestamp(), record.partition(), record.offset());
        }
    }

    /** One answer in the making. */
    private final class Reading {
        private final Range range;
        private final KafkaConsumer<byte[], byte[]> consumer;
        private final LinkedHashMap<String, ConsumerRecord<byte[], byte[]>> retained = new LinkedHashMap<>();
        /** The ids of what is kept, the oldest first: partitions are read one after the other. */
        private final TreeMap<Place, String> byTime = new TreeMap<>(Comparator.comparingLong(Place::time)
                .thenComparingInt(Place::partition)
                .thenComparingLong(Place::offset));

        private final Map<TopicPartition, Long> starts = new HashMap<>();
        private final Map<TopicPartition, Long> ends = new HashMap<>();
        /** Partitions of whose stretch the oldest is not there, or is not read. */
        private final Map<TopicPartition, Boolean> cutOff = new HashMap<>();

        private long bytes;
        private long since;

        Reading(Range range, KafkaConsumer<byte[], byte[]> consumer) {
            this.range = range;
            this.consumer = consumer;
            this.since = range.from();
        }

        Answer read() {
            bound();
            starts.forEach(consumer::seek);
            long deadline = System.nanoTime() + limits.time().toNanos();
            while (starts.keySet().stream().anyMatch(each -> consumer.position(each) < ends.get(each))) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    take(record);
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

        /** From where to where each partition is read. */
        private void bound() {
            List<TopicPartition> all = consumer.partitionsFor(range.topic()).stream()
                    .map(each -> new TopicPartition(each.topic(), each.partition()))
                    .toList();
            consumer.assign(all);
            Map<TopicPartition, Long> last = consumer.endOffsets(all);
            Map<TopicPartition, Long> first = consumer.beginningOffsets(all);
            Map<TopicPartition, OffsetAndTimestamp> from = consumer.offsetsForTimes(times(all, range.from()));
            Map<TopicPartition, OffsetAndTimestamp> to =
                    consumer.offsetsForTimes(times(all, Math.addExact(range.to(), DISORDER_MS)));
            long share = limits.scanned() / Math.max(1, all.size());
            for (TopicPartition each : all) {
                boolean toEnd = to.get(each) == null;
                long end = toEnd ? last.get(each) : to.get(each).offset();
                // of a stretch to the end no more records count than may be answered
                long maximum = toEnd && range.newest() == null ? Math.min(share, range.limit()) : share;
                long start = from.get(each) == null
                        ? end
                        : Math.min(end, from.get(each).offset());
                ends.put(each, end);
                starts.put(each, Math.max(start, end - maximum));
                cutOff.put(each, start < end - maximum || start < end && start == first.get(each) && start > 0);
            }
        }

        private static Map<TopicPartition, Long> times(List<TopicPartition> partitions, long time) {
            Map<TopicPartition, Long> times = new HashMap<>();
            partitions.forEach(each -> times.put(each, Math.max(0, time)));
            return times;
        }

        private void take(ConsumerRecord<byte[], byte[]> record) {
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
                byTime.remove(Place.of(older));
            }
            retained.put(id, record);
            byTime.put(Place.of(record), id);
            bytes += length(record);
            while (retained.size() > range.limit() || bytes > limits.answered() && retained.size() > 1) {
                ConsumerRecord<byte[], byte[]> oldest =
                        retained.remove(byTime.pollFirstEntry().getValue());
                bytes -= length(oldest);
                since = Math.max(since, oldest.timestamp() + 1);
            }
        }

        /** Of a deletion 0. */
        private static int length(ConsumerRecord<byte[], byte[]> record) {
            return record.value() == null ? 0 : record.value().length;
        }

        private String id(ConsumerRecord<byte[], byte[]> record) {
            String own = record.partition() + "/" + record.offset();
            if (range.newest() == null || record.value().length > valueBytes) {
                return own;
            }
            try {
                JsonNode read = NgsiJson.read(record.value());
                JsonNode member = read.path(range.newest());
                JsonNode value = member.isObject() ? member.path("value") : member;
                return value.isValueNode() && !value.asText().isEmpty()
                        ? "="
                                + KafkaClients.scope(record.headers())
                                        .identity(read.path("type").asText(""), value.asText())
                        : own;
            } catch (UnreadableException e) {
                return own;
            }
        }
    }
}
