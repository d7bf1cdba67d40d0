package io.furrow.soak.source;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.function.Consumer;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import io.furrow.model.topic.Topics;

/** The committed records of {@code data.raw}, from the beginning on. */
final class CommittedRecords implements AutoCloseable {
    private final Properties kafka = new Properties();
    private final KafkaConsumer<String, byte[]> consumer;

    CommittedRecords(String bootstrapServers) {
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

    /** Reads on to the end that the topic has now, also through transactions that are just being ended. */
    void read(Consumer<ConsumerRecord<String, byte[]>> reader) {
        Map<TopicPartition, Long> ends = endsWithOpenTransactions();
        long timeout = System.nanoTime() + Duration.ofSeconds(120).toNanos();
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            if (System.nanoTime() > timeout) {
                throw new IllegalStateException("the topic cannot be read to its end: a transaction is open");
            }
            consumer.poll(Duration.ofMillis(100)).forEach(reader);
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

    @Override
    public void close() {
        consumer.close();
    }
}
