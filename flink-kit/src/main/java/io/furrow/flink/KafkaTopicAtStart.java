package io.furrow.flink;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

/** Reads the topic from its beginning to where it ended when the reading began; a missing topic has no records. */
public final class KafkaTopicAtStart implements TopicAtStart {
    private static final long serialVersionUID = 1L;
    private static final Duration PATIENCE = Duration.ofMinutes(1);

    private final Properties client;
    private final String topic;

    public KafkaTopicAtStart(JobOptions options, String topic) {
        this.topic = topic;
        this.client = options.kafkaProperties();
        client.setProperty(ConsumerConfig.BOOTSTRAP_SERVERS_CONFIG, options.bootstrapServers());
        client.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        client.setProperty(ConsumerConfig.AUTO_OFFSET_RESET_CONFIG, "earliest");
        client.setProperty(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, "false");
        client.setProperty(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, "false");
        client.remove(ConsumerConfig.GROUP_ID_CONFIG);
    }

    @Override
    public List<TopicRecord> read() throws IOException {
        try (var consumer = new KafkaConsumer<>(client, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            List<PartitionInfo> partitions = consumer.partitionsFor(topic, PATIENCE);
            if (partitions == null || partitions.isEmpty()) {
                return List.of();
            }
            consumer.assign(partitions.stream()
                    .map(partition -> new TopicPartition(topic, partition.partition()))
                    .toList());
            consumer.seekToBeginning(consumer.assignment());
            return read(consumer, consumer.endOffsets(consumer.assignment(), PATIENCE));
        } catch (KafkaException e) {
            throw new IOException("topic " + topic + " could not be read", e);
        }
    }

    /** By position, because what ends a transaction is no record. */
    private List<TopicRecord> read(KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> ends)
            throws IOException {
        List<TopicRecord> records = new ArrayList<>();
        long until = System.nanoTime() + PATIENCE.toNanos();
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            if (System.nanoTime() > until) {
                throw new IOException("the end of " + topic + " was not reached within " + PATIENCE.toSeconds() + " s");
            }
            consumer.poll(Duration.ofMillis(200))
                    .forEach(record -> records.add(new TopicRecord(
                            topic,
                            record.partition(),
                            record.offset(),
                            record.timestamp(),
                            record.key(),
                            record.value(),
                            Map.of())));
        }
        return records;
    }
}
