package io.furrow.bench.ingest;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

/**
 * The topics that a job writes to, empty at first. How many records a reader of committed records could
 * read is reported from the ends of the partitions: reading them would take processor time from the job.
 */
final class WrittenTopics implements AutoCloseable {
    private final Admin admin;
    private final KafkaConsumer<byte[], byte[]> consumer;
    private final List<String> topics;
    private final List<TopicPartition> partitions = new ArrayList<>();

    /** @param beside topics that the job may make beside them; deleted too */
    WrittenTopics(Properties kafka, List<String> topics, int partitionsEach, List<String> beside)
            throws InterruptedException, ExecutionException {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.setProperty("isolation.level", "read_committed");
        settings.setProperty("max.poll.records", "5000");
        this.admin = Admin.create(kafka);
        this.consumer = new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        this.topics = new ArrayList<>(topics);
        this.topics.addAll(beside);
        admin.createTopics(topics.stream()
                        .map(name -> new NewTopic(name, Optional.of(partitionsEach), Optional.empty()))
                        .toList())
                .all()
                .get();
        for (String topic : topics) {
            for (int partition = 0; partition < partitionsEach; partition++) {
                partitions.add(new TopicPartition(topic, partition));
            }
        }
    }

    /** With exactly-once some more by the marks that end transactions: a few per partition and checkpoint. */
    long readable() {
        return consumer.endOffsets(partitions).values().stream()
                .mapToLong(Long::longValue)
                .sum();
    }

    /** Reads them all, to know that they are there. */
    long counted(long expected, Duration timeout) {
        consumer.assign(partitions);
        consumer.seekToBeginning(partitions);
        long records = 0;
        long end = System.nanoTime() + timeout.toNanos();
        while (records < expected && System.nanoTime() < end) {
            records += consumer.poll(Duration.ofMillis(100)).count();
        }
        Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
        while (partitions.stream().anyMatch(one -> consumer.position(one) < ends.get(one)) && System.nanoTime() < end) {
            records += consumer.poll(Duration.ofMillis(100)).count();
        }
        return records;
    }

    /** Those of them that are there. */
    void delete() throws InterruptedException, ExecutionException {
        Set<String> there = admin.listTopics().names().get();
        admin.deleteTopics(topics.stream().filter(there::contains).toList())
                .all()
                .get();
    }

    @Override
    public void close() {
        consumer.close();
        admin.close();
    }
}
