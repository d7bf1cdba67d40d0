package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.stream.IntStream;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.bench.analytics.load.FleetTopic;

/** Follows the topic of results: how far event time has come in it. */
final class FoundReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(FoundReader.class);

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Thread thread = new Thread(this::read, "bench-found");
    private volatile long newest = Long.MIN_VALUE;
    private volatile long count;

    FoundReader(Properties kafka, String topic) {
        Properties properties = new Properties();
        properties.putAll(kafka);
        consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        List<TopicPartition> partitions = IntStream.range(0, FleetTopic.PARTITIONS)
                .mapToObj(partition -> new TopicPartition(topic, partition))
                .toList();
        consumer.assign(partitions);
        consumer.seekToBeginning(partitions);
        thread.start();
    }

    /** Event time of the newest result; {@code Long.MIN_VALUE} before the first. */
    long newest() {
        return newest;
    }

    long count() {
        return count;
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread reads
    private void read() {
        try (consumer) {
            while (true) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(200))) {
                    newest = Math.max(newest, record.timestamp());
                    count++;
                }
            }
        } catch (WakeupException e) {
            LOG.debug("closed", e);
        }
    }

    @Override
    public void close() {
        consumer.wakeup();
        try {
            thread.join();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
