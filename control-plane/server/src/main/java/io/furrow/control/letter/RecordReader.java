package io.furrow.control.letter;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.TreeMap;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.topic.Topics;

/**
 * Reads records of topics, backwards from their ends in windows that grow: a page of the newest records reads little more than
 * these. Of the others no value is retained.
 */
public final class RecordReader {
    private static final int MAX_FETCHED_BYTES = 8 * 1024 * 1024;

    private final Properties client;

    /** @param client settings of a Kafka client */
    public RecordReader(Properties client) {
        this.client = client;
    }

    /**
     * What a page has.
     *
     * @param desired selects records
     * @param from time, epoch ms; {@code to} likewise, exclusive
     * @param limit number of records
     * @param whole whether with headers and values; a page of large values may have fewer records than the limit
     */
    public record Query(
            Predicate<ConsumerRecord<byte[], byte[]>> desired, long from, long to, int limit, boolean whole) {
        boolean selects(ConsumerRecord<byte[], byte[]> record) {
            return record.timestamp() >= from && record.timestamp() < to && desired.test(record);
        }
    }

    /**
     * A page of records, the newest first.
     *
     * @param next where the next page begins; empty if there is no older record
     */
    public record Page(List<StoredRecord> records, RecordPositions next) {}

    /**
     * Returns the newest records, those of a partition in the order of their offsets, those of different partitions by time. Because
     * the number of records is limited, a page may have fewer than requested, or none, and still a next page.
     *
     * @param topic null for all topics of dead letters
     * @param before where the previous page ended; null for the newest
     * @throws UnknownTopicOrPartitionException if there is no such topic
     * @throws org.apache.kafka.common.KafkaException if Kafka does not answer
     */
    public Page read(String topic, RecordPositions before, Query query) {
        try (KafkaConsumer<byte[], byte[]> consumer = consumer(client)) {
            List<TopicPartition> partitions = topic == null
                    ? deadLetters(consumer)
                    : partitions(consumer, topic, "the list of topics has those that there are");
            Map<TopicPartition, Long> begins = new HashMap<>(consumer.beginningOffsets(partitions, Redrive.TIMEOUT));
            Map<TopicPartition, Long> ends = new HashMap<>(consumer.endOffsets(partitions, Redrive.TIMEOUT));
            if (query.from() > 0) { // no earlier record of a partition has this time
                Map<TopicPartition, Long> times = new HashMap<>();
                partitions.forEach(partition -> times.put(partition, query.from()));
                consumer.offsetsForTimes(times, Redrive.TIMEOUT)
                        .forEach((partition, found) ->
                                begins.put(partition, found == null ? ends.get(partition) : (Long) found.offset()));
            }
            if (before != null) {
                ends.keySet().retainAll(before.ends().keySet());
                ends.replaceAll((partition, end) -> Math.min(end, before.ends().get(partition)));
            }
            return new RecordScan(consumer, begins, ends, query).page();
        }
    }

    /**
     * Returns a record with headers and value; empty if there is none at this place.
     *
     * @throws UnknownTopicOrPartitionException if there is no such topic
     * @throws IOException if Kafka does not answer
     */
    public Optional<ObjectNode> find(String topic, int partition, long offset) throws IOException {
        try (var originals = new OriginalReader(consumer(client))) {
            return originals
                    .find(new TopicPartition(topic, partition), offset)
                    .map(record -> StoredRecord.of(record, true).json());
        }
    }

    /** A topic. @param records how many it has at most: transaction markers and compacted records count, too */
    public record Topic(String name, int partitions, long records) {}

    /** Returns the topics whose names are desired, sorted. */
    public List<Topic> topics(Predicate<String> desired) {
        try (KafkaConsumer<byte[], byte[]> consumer = consumer(client)) {
            Map<String, List<TopicPartition>> topics = new TreeMap<>();
            partitions(consumer, desired)
                    .forEach(each -> topics.computeIfAbsent(each.topic(), topic -> new ArrayList<>())
                            .add(each));
            List<TopicPartition> all =
                    topics.values().stream().flatMap(List::stream).toList();
            Map<TopicPartition, Long> begins = consumer.beginningOffsets(all, Redrive.TIMEOUT);
            Map<TopicPartition, Long> ends = consumer.endOffsets(all, Redrive.TIMEOUT);
            return topics.entrySet().stream()
                    .map(topic -> new Topic(
                            topic.getKey(),
                            topic.getValue().size(),
                            topic.getValue().stream()
                                    .mapToLong(each -> ends.getOrDefault(each, 0L) - begins.getOrDefault(each, 0L))
                                    .sum()))
                    .toList();
        }
    }

    private static List<TopicPartition> deadLetters(KafkaConsumer<byte[], byte[]> consumer) {
        return partitions(consumer, topic -> Topics.ofDeadLetters(topic).isPresent());
    }

    private static List<TopicPartition> partitions(KafkaConsumer<byte[], byte[]> consumer, Predicate<String> desired) {
        return consumer.listTopics(Redrive.TIMEOUT).entrySet().stream()
                .filter(topic -> desired.test(topic.getKey()))
                .flatMap(topic -> topic.getValue().stream())
                .map(partition -> new TopicPartition(partition.topic(), partition.partition()))
                .toList();
    }

    /**
     * Returns the partitions of a topic.
     *
     * @param remedy what to do without it
     * @throws UnknownTopicOrPartitionException if there is no such topic
     */
    static List<TopicPartition> partitions(KafkaConsumer<byte[], byte[]> consumer, String topic, String remedy) {
        List<PartitionInfo> partitions = consumer.partitionsFor(topic, Redrive.TIMEOUT);
        if (partitions == null || partitions.isEmpty()) {
            throw new UnknownTopicOrPartitionException("there is no topic '%s'; %s".formatted(topic, remedy));
        }
        return partitions.stream()
                .map(partition -> new TopicPartition(topic, partition.partition()))
                .toList();
    }

    /** @param client settings of a Kafka client */
    static KafkaConsumer<byte[], byte[]> consumer(Properties client) {
        Properties settings = CommittedReader.boundedSettings(client);
        settings.put(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(Redrive.TIMEOUT.toMillis()));
        settings.put(ConsumerConfig.FETCH_MAX_BYTES_CONFIG, Integer.toString(MAX_FETCHED_BYTES));
        return new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }
}
