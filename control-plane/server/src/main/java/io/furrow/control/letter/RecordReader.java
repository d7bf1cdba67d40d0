package io.furrow.control.letter;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.Deque;
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
import org.apache.kafka.common.errors.TimeoutException;
import org.apache.kafka.common.errors.UnknownTopicOrPartitionException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.kafka.CommittedReader;
import io.furrow.model.topic.Topics;

/**
 * Reads records of topics, backwards from their ends in windows that grow: a page of the newest records reads little more than
 * these. Of the others no value is retained.
 */
public final class RecordReader {
    /** Maximum number of records that one page reads. */
    static final int MAX_READ = 20_000;

    private static final int MAX_WINDOW = 1_000;
    /** Maximum size of all windows together, where values are retained. */
    private static final int MAX_VALUES = 200;
    /** Bytes of values after which a page ends. */
    private static final long MAX_VALUE_BYTES = 4L << 20;

    private static final int MAX_FETCHED_BYTES = 8 * 1024 * 1024;
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Comparator<Deque<Candidate>> BY_TIME =
            Comparator.comparingLong(window -> window.peek().record().time());

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
        private Candidate candidate(ConsumerRecord<byte[], byte[]> record) {
            boolean isDesired = record.timestamp() >= from && record.timestamp() < to && desired.test(record);
            return new Candidate(StoredRecord.of(record, isDesired && whole), isDesired);
        }
    }

    private record Candidate(StoredRecord record, boolean isDesired) {
        int retained() {
            return record.contents() == null || record.contents().value() == null
                    ? 0
                    : record.contents().value().length;
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
            return new Scan(consumer, begins, ends, query).page();
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

    /** One pass backwards. A partition has a window of records that are read and not yet returned, the newest first. */
    private static final class Scan {
        private final KafkaConsumer<byte[], byte[]> consumer;
        private final Map<TopicPartition, Long> begins;
        /** The starts of the windows. */
        private final Map<TopicPartition, Long> starts;

        private final Map<TopicPartition, Deque<Candidate>> windows = new HashMap<>();
        private final Query query;
        private final List<StoredRecord> found = new ArrayList<>();
        private long foundBytes;
        private final long begin = System.nanoTime();

        Scan(
                KafkaConsumer<byte[], byte[]> consumer,
                Map<TopicPartition, Long> begins,
                Map<TopicPartition, Long> ends,
                Query query) {
            this.consumer = consumer;
            this.query = query;
            this.begins = begins;
            this.starts = ends;
            ends.keySet().forEach(partition -> windows.put(partition, new ArrayDeque<>()));
        }

        Page page() {
            int max = query.whole() ? Math.max(1, MAX_VALUES / Math.max(1, starts.size())) : MAX_WINDOW;
            int size = Math.min(max, 2 + 2 * query.limit() / Math.max(1, starts.size()));
            List<TopicPartition> unread = unread();
            for (long records = 0;
                    !unread.isEmpty() && records < MAX_READ && !isFull() && !isLate(2);
                    unread = unread()) {
                read(unread, size);
                records += (long) size * unread.size();
                size = Math.min(max, 2 * size);
                merge();
            }
            return new Page(found, next());
        }

        private boolean isFull() {
            return found.size() >= query.limit() || foundBytes >= MAX_VALUE_BYTES;
        }

        /** Whether this part of the time for a page is over. */
        private boolean isLate(int part) {
            return System.nanoTime() - begin > Redrive.TIMEOUT.toNanos() / part;
        }

        /** Returns the partitions of which the next letter is not known. */
        private List<TopicPartition> unread() {
            return starts.keySet().stream().filter(this::isUnread).toList();
        }

        private boolean isUnread(TopicPartition partition) {
            return windows.get(partition).isEmpty() && starts.get(partition) > begins.get(partition);
        }

        private void merge() {
            while (!isFull() && unread().isEmpty()) {
                Optional<Deque<Candidate>> newest = windows.values().stream()
                        .filter(window -> !window.isEmpty())
                        .max(BY_TIME);
                if (newest.isEmpty()) {
                    return;
                }
                Candidate candidate = newest.get().pop();
                if (candidate.isDesired()) {
                    found.add(candidate.record());
                    foundBytes += candidate.retained();
                }
            }
        }

        private void read(Collection<TopicPartition> partitions, int size) {
            Map<TopicPartition, Long> ends = new HashMap<>();
            consumer.assign(partitions);
            consumer.resume(partitions);
            for (TopicPartition partition : partitions) {
                long end = starts.get(partition);
                long start = Math.max(begins.get(partition), end - size);
                ends.put(partition, end);
                starts.put(partition, start);
                consumer.seek(partition, start);
            }
            while (!ends.isEmpty()) {
                if (isLate(1)) {
                    throw new TimeoutException("the records were not read within " + Redrive.TIMEOUT);
                }
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    TopicPartition partition = new TopicPartition(record.topic(), record.partition());
                    if (record.offset() < ends.getOrDefault(partition, 0L)) {
                        windows.get(partition).push(query.candidate(record));
                    }
                }
                List<TopicPartition> done = ends.keySet().stream()
                        .filter(partition -> consumer.position(partition) >= ends.get(partition))
                        .toList();
                consumer.pause(done);
                ends.keySet().removeAll(done);
            }
        }

        /** Partitions without older records are left out. */
        private RecordPositions next() {
            Map<TopicPartition, Long> next = new HashMap<>();
            starts.forEach((partition, start) -> {
                Candidate first = windows.get(partition).peek();
                long end = first == null ? start : first.record().offset() + 1;
                if (end > begins.get(partition)) {
                    next.put(partition, end);
                }
            });
            return new RecordPositions(next);
        }
    }
}
