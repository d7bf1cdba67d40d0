package io.furrow.flink;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

/**
 * Reads the topic from its beginning to where it ended when the reading began; a missing topic has no records. Operators of one
 * process that ask for all records of a topic at the same time share one reading. A reading takes as long as records come; it
 * fails when the broker gave nothing for {@code default.api.timeout.ms} of the Kafka properties, a minute unless they say
 * otherwise.
 */
public final class KafkaTopicAtStart implements TopicAtStart {
    private static final long serialVersionUID = 1L;
    private static final String TIMEOUT = ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG;
    private static final SharedReads<Properties, List<TopicRecord>> UNDER_WAY = new SharedReads<>();

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
        client.putIfAbsent(TIMEOUT, "60000");
        client.remove(ConsumerConfig.GROUP_ID_CONFIG);
    }

    @Override
    public List<TopicRecord> read() throws IOException {
        Properties same = (Properties) client.clone();
        same.setProperty("topic", topic);
        return UNDER_WAY.join(same, () -> {
            List<TopicRecord> records = new ArrayList<>();
            forEach(records::add);
            return List.copyOf(records);
        });
    }

    @Override
    public <E extends Exception> void forEach(Taker<E> taker) throws IOException, E {
        try (var consumer = new KafkaConsumer<>(client, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            Duration timeout = Duration.ofMillis(Long.parseLong(client.getProperty(TIMEOUT))); // the consumer took it
            List<PartitionInfo> partitions = consumer.partitionsFor(topic, timeout);
            if (partitions == null || partitions.isEmpty()) {
                return;
            }
            consumer.assign(partitions.stream()
                    .map(partition -> new TopicPartition(topic, partition.partition()))
                    .toList());
            consumer.seekToBeginning(consumer.assignment());
            read(consumer, consumer.endOffsets(consumer.assignment(), timeout), timeout, taker);
        } catch (KafkaException e) {
            throw new IOException(
                    "topic " + topic + " could not be read; does its broker answer? It may take the time that "
                            + TIMEOUT + " in --kafka-properties says",
                    e);
        }
    }

    /** By position, because what ends a transaction is no record. */
    private <E extends Exception> void read(
            KafkaConsumer<byte[], byte[]> consumer, Map<TopicPartition, Long> ends, Duration timeout, Taker<E> taker)
            throws IOException, E {
        long reached = -1;
        long until = 0;
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey(), timeout) < end.getValue())) {
            long now = ends.keySet().stream().mapToLong(consumer::position).sum();
            if (now > reached) {
                reached = now;
                until = System.nanoTime() + timeout.toNanos();
            } else if (System.nanoTime() > until) {
                throw new IOException("nothing came of " + topic + " for " + timeout.toMillis()
                        + " ms, before its end; does its broker answer? It may take the time that " + TIMEOUT
                        + " in --kafka-properties says");
            }
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(200))) {
                taker.take(new TopicRecord(
                        topic,
                        record.partition(),
                        record.offset(),
                        record.timestamp(),
                        record.key(),
                        record.value(),
                        HeaderTexts.of(record.headers().toArray())));
            }
        }
    }
}
