package io.furrow.soak.ingest;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeSet;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.model.topic.Topics;

/** Reads the committed records of the topics {@code data.*} that the job writes. */
final class CommittedTopics implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofMinutes(1);

    private final KafkaConsumer<byte[], byte[]> committed;
    private final KafkaConsumer<byte[], byte[]> uncommitted;

    CommittedTopics(String bootstrapServers) {
        this.committed = consumer(bootstrapServers, "read_committed");
        this.uncommitted = consumer(bootstrapServers, "read_uncommitted");
    }

    private static KafkaConsumer<byte[], byte[]> consumer(String bootstrapServers, String isolation) {
        return new KafkaConsumer<>(
                Map.of(
                        "bootstrap.servers", bootstrapServers,
                        "auto.offset.reset", "earliest",
                        "enable.auto.commit", "false",
                        "allow.auto.create.topics", "false",
                        "isolation.level", isolation),
                new ByteArrayDeserializer(),
                new ByteArrayDeserializer());
    }

    TreeSet<String> names() {
        TreeSet<String> names = new TreeSet<>(committed.listTopics().keySet());
        names.removeIf(name -> !name.startsWith("data.") || name.equals(Topics.RAW));
        return names;
    }

    /** All records up to the current end of the topic. */
    List<ConsumerRecord<byte[], byte[]>> read(String topic) throws IOException {
        List<TopicPartition> partitions = partitions(topic);
        committed.assign(partitions);
        committed.seekToBeginning(partitions);
        Map<TopicPartition, Long> ends = committed.endOffsets(partitions);
        List<ConsumerRecord<byte[], byte[]>> records = new ArrayList<>();
        long until = System.nanoTime() + TIMEOUT.toNanos();
        while (ends.entrySet().stream().anyMatch(end -> committed.position(end.getKey()) < end.getValue())) {
            if (System.nanoTime() > until) {
                throw new IOException("the end of " + topic + " was not reached within " + TIMEOUT);
            }
            committed.poll(Duration.ofMillis(100)).forEach(records::add);
        }
        return records;
    }

    /** Partitions with records of an open transaction, behind which readers of committed records wait. */
    List<String> behindAnOpenTransaction() {
        List<TopicPartition> all =
                names().stream().flatMap(name -> partitions(name).stream()).toList();
        Map<TopicPartition, Long> ends = uncommitted.endOffsets(all);
        return committed.endOffsets(all).entrySet().stream()
                .filter(end -> end.getValue() < ends.get(end.getKey()))
                .map(end -> end.getKey().toString())
                .sorted()
                .toList();
    }

    private List<TopicPartition> partitions(String topic) {
        return committed.partitionsFor(topic).stream()
                .map(info -> new TopicPartition(topic, info.partition()))
                .toList();
    }

    @Override
    public void close() {
        committed.close();
        uncommitted.close();
    }
}
