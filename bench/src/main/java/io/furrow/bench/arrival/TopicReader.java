package io.furrow.bench.arrival;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.function.Consumer;

import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Reads what is committed in one topic from its end of now on, on a thread of its own. */
public final class TopicReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(TopicReader.class);

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Consumer<ConsumerRecords<byte[], byte[]>> arrival;
    private final Thread thread = new Thread(this::read, "bench-reader");

    /**
     * @param fetching settings of the consumer beside those of the client
     * @param arrival gets what came together, on the reader's thread, as soon as it is there
     */
    public TopicReader(
            Properties client,
            String topic,
            Map<String, String> fetching,
            Consumer<ConsumerRecords<byte[], byte[]>> arrival) {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.putAll(fetching);
        properties.setProperty("isolation.level", "read_committed");
        this.consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        this.arrival = arrival;
        List<TopicPartition> partitions = consumer.partitionsFor(topic).stream()
                .map(info -> new TopicPartition(topic, info.partition()))
                .toList();
        consumer.assign(partitions);
        consumer.seekToEnd(partitions);
        partitions.forEach(consumer::position); // seeks are lazy; from here on nothing is missed
    }

    public void start() {
        thread.start();
    }

    private void read() {
        try (consumer) {
            while (true) {
                arrival.accept(consumer.poll(Duration.ofMillis(200)));
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
