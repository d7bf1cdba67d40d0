package io.furrow.bench.frame;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.locks.LockSupport;
import java.util.function.Consumer;
import java.util.stream.Stream;

import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Reads topics from their beginning or from their current end, on its own thread or when polled. */
public final class TopicReader implements AutoCloseable {
    /** Reads committed records only. */
    public static final Map<String, String> COMMITTED = Map.of("isolation.level", "read_committed");

    private static final Logger LOG = LoggerFactory.getLogger(TopicReader.class);
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration BETWEEN_POLLS = Duration.ofMillis(20);
    private static final int POLLS = 500;

    private final KafkaConsumer<byte[], byte[]> consumer;
    private Thread thread;

    private TopicReader(Properties client, Map<String, String> settings) {
        Properties all = new Properties();
        all.putAll(client);
        all.putAll(settings);
        consumer = new KafkaConsumer<>(all, new ByteArrayDeserializer(), new ByteArrayDeserializer());
    }

    /** @param settings of the consumer in addition to those of the client */
    public static TopicReader fromBeginning(Properties client, Map<String, String> settings, String... topics) {
        TopicReader reader = new TopicReader(client, settings);
        reader.consumer.seekToBeginning(reader.assign(topics));
        return reader;
    }

    /** Misses nothing from here on. @param settings of the consumer in addition to those of the client */
    public static TopicReader fromEnd(Properties client, Map<String, String> settings, String... topics) {
        TopicReader reader = new TopicReader(client, settings);
        List<TopicPartition> partitions = reader.assign(topics);
        reader.consumer.seekToEnd(partitions);
        partitions.forEach(reader.consumer::position); // seeks are lazy
        return reader;
    }

    private List<TopicPartition> assign(String... topics) {
        List<TopicPartition> partitions =
                Stream.of(topics).flatMap(this::partitions).toList();
        consumer.assign(partitions);
        return partitions;
    }

    /** A broker may not have metadata of a new topic yet. */
    private Stream<TopicPartition> partitions(String topic) {
        List<PartitionInfo> known = consumer.partitionsFor(topic);
        for (int polls = 0; known.isEmpty() && polls < POLLS; polls++) {
            LockSupport.parkNanos(BETWEEN_POLLS.toNanos());
            known = consumer.partitionsFor(topic);
        }
        return known.stream().map(info -> new TopicPartition(topic, info.partition()));
    }

    /** Reads on its own thread until it is closed. @param arrival receives each batch at once */
    public TopicReader follow(Consumer<ConsumerRecords<byte[], byte[]>> arrival) {
        thread = new Thread(() -> read(arrival), "bench-reader");
        thread.start();
        return this;
    }

    private void read(Consumer<ConsumerRecords<byte[], byte[]>> arrival) {
        try (consumer) {
            while (true) {
                arrival.accept(consumer.poll(POLL));
            }
        } catch (WakeupException e) {
            LOG.debug("closed", e);
        }
    }

    /** Polls for records; must not be used together with {@link #follow}. */
    public ConsumerRecords<byte[], byte[]> poll(Duration wait) {
        return consumer.poll(wait);
    }

    /** Sum of the current end offsets. */
    public long end() {
        return consumer.endOffsets(consumer.assignment()).values().stream()
                .mapToLong(Long::longValue)
                .sum();
    }

    /** Whether everything up to the current end was polled. */
    public boolean isAtEnd() {
        return consumer.assignment().stream().mapToLong(consumer::position).sum() >= end();
    }

    public static String text(byte[] bytes) {
        return new String(bytes, StandardCharsets.UTF_8);
    }

    @Override
    public void close() {
        if (thread == null) {
            consumer.close();
            return;
        }
        consumer.wakeup();
        try {
            thread.join();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
