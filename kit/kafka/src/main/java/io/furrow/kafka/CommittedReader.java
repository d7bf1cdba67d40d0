package io.furrow.kafka;

import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.CloseOptions;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.clients.consumer.OffsetAndTimestamp;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.TimeoutException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.Deserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import static java.util.function.Function.identity;
import static java.util.stream.Collectors.toMap;

/**
 * Reads the committed records of topics from their beginning, with a consumer without a group: each reader reads all
 * partitions. Progress is measured by positions, because a transaction marker has an offset but is not a record. Not
 * thread-safe.
 *
 * @param <K> type of keys; values are bytes
 */
public final class CommittedReader<K> implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(200);
    private static final String TIMEOUT = "default.api.timeout.ms";
    private static final String DEFAULT_TIMEOUT_MS = "60000";

    private final KafkaConsumer<K, byte[]> consumer;
    private final Duration timeout;
    private List<TopicPartition> partitions = List.of();
    private final Map<TopicPartition, Long> ends = new HashMap<>();

    private CommittedReader(Properties client, Deserializer<K> keys) {
        Properties settings = settings(client);
        timeout = Duration.ofMillis(Long.parseLong(
                settings.getOrDefault(TIMEOUT, DEFAULT_TIMEOUT_MS).toString()));
        consumer = new KafkaConsumer<>(settings, keys, new ByteArrayDeserializer());
    }

    /**
     * Opens a reader of text keys at the beginning of the topics.
     *
     * @param client settings of Kafka clients, including {@code bootstrap.servers}
     * @throws UnknownTopicOrPartitionException if one of the topics does not exist
     * @throws org.apache.kafka.common.KafkaException if Kafka does not respond within {@code default.api.timeout.ms}
     */
    public static CommittedReader<String> open(Properties client, String... topics) {
        CommittedReader<String> reader = openExisting(client, topics);
        List<String> missing = reader.missing(List.of(topics));
        if (!missing.isEmpty()) {
            reader.close();
            throw new UnknownTopicOrPartitionException("the topics " + missing + " do not exist");
        }
        return reader;
    }

    /** Like {@link #open}, but skips topics that do not exist. */
    public static CommittedReader<String> openExisting(Properties client, String... topics) {
        return new CommittedReader<>(client, new StringDeserializer()).at(topics);
    }

    /** Like {@link #openExisting}, with keys as bytes. */
    public static CommittedReader<byte[]> openBytes(Properties client, String... topics) {
        return new CommittedReader<>(client, new ByteArrayDeserializer()).at(topics);
    }

    /** Returns a reader without topics, which has not contacted Kafka yet. */
    public static CommittedReader<String> unassigned(Properties client) {
        return new CommittedReader<>(client, new StringDeserializer());
    }

    /** Settings of a read-committed consumer without a consumer group. */
    public static Properties settings(Properties client) {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.remove("group.id");
        settings.put("isolation.level", "read_committed");
        settings.put("enable.auto.commit", "false");
        settings.put("auto.offset.reset", "earliest");
        settings.put("allow.auto.create.topics", "false");
        return settings;
    }

    /**
     * Like {@link #settings}, for a consumer that reads to the end and is closed then: {@code close} waits for a fetch
     * that is pending at the broker.
     */
    public static Properties boundedSettings(Properties client) {
        Properties settings = settings(client);
        settings.put("fetch.max.wait.ms", "10");
        return settings;
    }

    private CommittedReader<K> at(String... topics) {
        try {
            assign(List.of(topics));
            return this;
        } catch (RuntimeException e) { // Kafka is unavailable, and the caller gets no reader that it could close
            consumer.close(CloseOptions.timeout(Duration.ZERO));
            throw e;
        }
    }

    /** Assigns the current partitions of the topics; new ones are read from their beginning. Returns whether all topics exist. */
    public boolean assign(Collection<String> topics) {
        partitions = topics.stream()
                .flatMap(topic -> consumer.partitionsFor(topic).stream())
                .map(info -> new TopicPartition(info.topic(), info.partition()))
                .toList();
        List<TopicPartition> added =
                partitions.stream().filter(each -> !ends.containsKey(each)).toList();
        if (!added.isEmpty()) {
            consumer.assign(partitions);
            consumer.seekToBeginning(added);
            ends.putAll(consumer.endOffsets(added));
        }
        return missing(topics).isEmpty();
    }

    /** Whether the topic existed when partitions were assigned. */
    public boolean isAssigned(String topic) {
        return partitions.stream().anyMatch(each -> each.topic().equals(topic));
    }

    private List<String> missing(Collection<String> topics) {
        return topics.stream().filter(topic -> !isAssigned(topic)).toList();
    }

    /** Continues with the first record of each partition that has at least this timestamp, epoch ms. */
    public CommittedReader<K> seekToTime(long time) {
        Map<TopicPartition, OffsetAndTimestamp> found =
                consumer.offsetsForTimes(partitions.stream().collect(toMap(identity(), partition -> time)));
        partitions.forEach(partition -> consumer.seek(
                partition,
                found.get(partition) == null
                        ? ends.get(partition)
                        : found.get(partition).offset()));
        return this;
    }

    /** Continues with at most this number of records before the end, in equal shares of the partitions. */
    public CommittedReader<K> seekToNewest(long records) {
        long share = Math.max(1, records / Math.max(1, partitions.size()));
        Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions);
        partitions.forEach(
                partition -> consumer.seek(partition, Math.max(begins.get(partition), ends.get(partition) - share)));
        return this;
    }

    /** Returns the records that have arrived, or waits for some. */
    public ConsumerRecords<K, byte[]> poll(Duration wait) {
        return consumer.poll(wait);
    }

    /** Whether all records that existed when partitions were assigned have been returned. */
    public boolean isCaughtUp() {
        return ends.entrySet().stream().allMatch(end -> consumer.position(end.getKey()) >= end.getValue());
    }

    /** Whether the record existed when partitions were assigned, or when {@link #readToEnd} began. */
    public boolean isBeforeEnd(ConsumerRecord<K, byte[]> record) {
        return record.offset() < ends.get(new TopicPartition(record.topic(), record.partition()));
    }

    /**
     * Reads to the current end of the topics; the last poll may return records beyond it.
     *
     * @throws TimeoutException if there is no progress for {@code default.api.timeout.ms}
     * @throws E if the action does
     */
    public <E extends Exception> void readToEnd(RecordAction<K, E> action) throws E {
        ends.putAll(consumer.endOffsets(partitions));
        long reached = -1;
        long deadline = 0;
        while (!isCaughtUp()) {
            long now = partitions.stream().mapToLong(consumer::position).sum();
            if (now > reached) {
                reached = now;
                deadline = System.nanoTime() + timeout.toNanos();
            } else if (System.nanoTime() > deadline) {
                throw new TimeoutException(
                        "%s: no records before the end for %d ms".formatted(partitions, timeout.toMillis()));
            }
            for (ConsumerRecord<K, byte[]> record : consumer.poll(POLL)) {
                action.accept(record);
            }
        }
    }

    /** Makes a waiting {@link #poll} fail with a {@code WakeupException}. Thread-safe. */
    public void wakeup() {
        consumer.wakeup();
    }

    /** Does not wait for a fetch that is pending at the broker, for up to {@code fetch.max.wait.ms}. */
    @Override
    public void close() {
        consumer.close(CloseOptions.timeout(Duration.ZERO));
    }

    /** Processes a record. */
    @FunctionalInterface
    public interface RecordAction<K, E extends Exception> {
        void accept(ConsumerRecord<K, byte[]> record) throws E;
    }
}
