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
 * Reads dead letters of all topics, backwards from their ends in windows that grow: a page of the newest letters reads little more
 * than these. The values are not retained.
 */
public final class DeadLetterReader {
    /** Maximum number of records that one page reads. */
    static final int MAX_READ = 20_000;

    private static final int MAX_WINDOW = 1_000;
    private static final int MAX_FETCHED_BYTES = 8 * 1024 * 1024;
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Comparator<Deque<StoredLetter>> BY_TIME =
            Comparator.comparingLong(window -> window.peek().time());

    private final Properties client;

    /** @param client settings of a Kafka client */
    public DeadLetterReader(Properties client) {
        this.client = client;
    }

    /**
     * A page of letters, the newest first.
     *
     * @param next where the next page begins; empty if there is no older letter
     */
    public record Page(List<StoredLetter> letters, LetterPositions next) {}

    /**
     * Returns the newest letters, those of a partition in the order of their offsets, those of different partitions by time. Because
     * the number of records is limited, a page may have fewer letters than requested, or none, and still a next page.
     *
     * @param topic of dead letters; null for all
     * @param before where the previous page ended; null for the newest
     * @throws UnknownTopicOrPartitionException if there is no such topic
     * @throws org.apache.kafka.common.KafkaException if Kafka does not answer
     */
    public Page read(String topic, LetterPositions before, int limit, Predicate<StoredLetter> desired) {
        try (KafkaConsumer<byte[], byte[]> consumer = consumer(client)) {
            List<TopicPartition> partitions = topic == null
                    ? partitions(consumer)
                    : partitions(consumer, topic, "without a topic the letters of all topics are listed");
            Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions, Redrive.TIMEOUT);
            Map<TopicPartition, Long> ends = new HashMap<>(consumer.endOffsets(partitions, Redrive.TIMEOUT));
            if (before != null) {
                ends.keySet().retainAll(before.ends().keySet());
                ends.replaceAll((partition, end) -> Math.min(end, before.ends().get(partition)));
            }
            return new Scan(consumer, begins, ends).page(limit, desired);
        }
    }

    /**
     * Returns a letter with headers and value; empty if there is none at this place.
     *
     * @throws UnknownTopicOrPartitionException if there is no such topic
     * @throws IOException if Kafka does not answer
     */
    public Optional<ObjectNode> find(String topic, int partition, long offset) throws IOException {
        try (var originals = new OriginalReader(consumer(client))) {
            return originals.find(new TopicPartition(topic, partition), offset).map(StoredLetter::whole);
        }
    }

    private static List<TopicPartition> partitions(KafkaConsumer<byte[], byte[]> consumer) {
        return consumer.listTopics(Redrive.TIMEOUT).entrySet().stream()
                .filter(topic -> Topics.ofDeadLetters(topic.getKey()).isPresent())
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

    /** One pass backwards. A partition has a window of letters that are read and not yet returned, the newest first. */
    private static final class Scan {
        private final KafkaConsumer<byte[], byte[]> consumer;
        private final Map<TopicPartition, Long> begins;
        /** The starts of the windows. */
        private final Map<TopicPartition, Long> starts;

        private final Map<TopicPartition, Deque<StoredLetter>> windows = new HashMap<>();
        private final long deadline = System.nanoTime() + Redrive.TIMEOUT.toNanos();

        Scan(KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> begins, Map<TopicPartition, Long> ends) {
            this.consumer = consumer;
            this.begins = begins;
            this.starts = ends;
            ends.keySet().forEach(partition -> windows.put(partition, new ArrayDeque<>()));
        }

        Page page(int limit, Predicate<StoredLetter> desired) {
            List<StoredLetter> found = new ArrayList<>();
            int size = Math.min(MAX_WINDOW, 2 + 2 * limit / Math.max(1, starts.size()));
            List<TopicPartition> unread = unread();
            for (long records = 0; !unread.isEmpty() && records < MAX_READ && found.size() < limit; unread = unread()) {
                read(unread, size);
                records += (long) size * unread.size();
                size = Math.min(MAX_WINDOW, 2 * size);
                merge(found, limit, desired);
            }
            return new Page(found, next());
        }

        /** Returns the partitions of which the next letter is not known. */
        private List<TopicPartition> unread() {
            return starts.keySet().stream().filter(this::isUnread).toList();
        }

        private boolean isUnread(TopicPartition partition) {
            return windows.get(partition).isEmpty() && starts.get(partition) > begins.get(partition);
        }

        private void merge(List<StoredLetter> found, int limit, Predicate<StoredLetter> desired) {
            while (found.size() < limit && unread().isEmpty()) {
                Optional<Deque<StoredLetter>> newest = windows.values().stream()
                        .filter(window -> !window.isEmpty())
                        .max(BY_TIME);
                if (newest.isEmpty()) {
                    return;
                }
                StoredLetter letter = newest.get().pop();
                if (desired.test(letter)) {
                    found.add(letter);
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
                if (System.nanoTime() > deadline) {
                    throw new TimeoutException("dead letters were not read within " + Redrive.TIMEOUT);
                }
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                    TopicPartition partition = new TopicPartition(record.topic(), record.partition());
                    if (record.offset() < ends.getOrDefault(partition, 0L)) {
                        windows.get(partition).push(StoredLetter.of(record));
                    }
                }
                List<TopicPartition> done = ends.keySet().stream()
                        .filter(partition -> consumer.position(partition) >= ends.get(partition))
                        .toList();
                consumer.pause(done);
                ends.keySet().removeAll(done);
            }
        }

        /** Partitions without older letters are left out. */
        private LetterPositions next() {
            Map<TopicPartition, Long> next = new HashMap<>();
            starts.forEach((partition, start) -> {
                StoredLetter first = windows.get(partition).peek();
                long end = first == null ? start : first.offset() + 1;
                if (end > begins.get(partition)) {
                    next.put(partition, end);
                }
            });
            return new LetterPositions(next);
        }
    }
}
