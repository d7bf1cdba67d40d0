package io.furrow.soak.source;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.BitSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.topic.Topics;

/** What of the numbered notifications is on {@code data.raw}, committed; grows with each reading. */
final class Delivered implements AutoCloseable {
    private final Properties kafka = new Properties();
    private final KafkaConsumer<String, byte[]> consumer;
    private final Map<Integer, String> events = new HashMap<>();
    private int repeated;
    private int repeatedWithAnotherId;

    Delivered(String bootstrapServers) {
        kafka.setProperty("bootstrap.servers", bootstrapServers);
        kafka.setProperty("isolation.level", "read_committed");
        kafka.setProperty("auto.offset.reset", "earliest");
        kafka.setProperty("enable.auto.commit", "false");
        consumer = new KafkaConsumer<>(kafka, new StringDeserializer(), new ByteArrayDeserializer());
        List<TopicPartition> partitions = consumer.partitionsFor(Topics.RAW).stream()
                .map(partition -> new TopicPartition(Topics.RAW, partition.partition()))
                .toList();
        consumer.assign(partitions);
    }

    /** Reads to the end that the topic has now, also through transactions that are just being ended. */
    void read() {
        Map<TopicPartition, Long> ends = endsWithOpenTransactions();
        long patience = System.nanoTime() + Duration.ofSeconds(120).toNanos();
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            if (System.nanoTime() > patience) {
                throw new IllegalStateException("the topic cannot be read to its end: a transaction is open");
            }
            for (ConsumerRecord<String, byte[]> record : consumer.poll(Duration.ofMillis(100))) {
                count(record);
            }
        }
    }

    private Map<TopicPartition, Long> endsWithOpenTransactions() {
        Properties uncommitted = new Properties();
        uncommitted.putAll(kafka);
        uncommitted.setProperty("isolation.level", "read_uncommitted");
        try (var any = new KafkaConsumer<>(uncommitted, new StringDeserializer(), new ByteArrayDeserializer())) {
            return any.endOffsets(consumer.assignment());
        }
    }

    private void count(ConsumerRecord<String, byte[]> record) {
        int number = Integer.parseInt(record.key().substring(record.key().lastIndexOf(':') + 1));
        String event = new String(record.headers().lastHeader(HeaderNames.CE_ID).value(), StandardCharsets.UTF_8);
        String before = events.putIfAbsent(number, event);
        if (before != null) {
            repeated++;
            repeatedWithAnotherId += before.equals(event) ? 0 : 1;
        }
    }

    /** How many of these are not there. */
    int missingOf(BitSet acknowledged) {
        return (int) acknowledged.stream()
                .filter(number -> !events.containsKey(number))
                .count();
    }

    int count() {
        return events.size();
    }

    /** Records that were there before. */
    int repeated() {
        return repeated;
    }

    /** Those of them whose {@code ce_id} differs from the first. */
    int repeatedWithAnotherId() {
        return repeatedWithAnotherId;
    }

    @Override
    public void close() {
        consumer.close();
    }
}
