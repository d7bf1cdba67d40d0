package io.furrow.bench.notifications;

import java.time.Duration;
import java.util.List;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.ConsumerRecords;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Reads what is committed in one topic from its end of now on, in large pieces, because it shares the processors. */
final class RecordReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(RecordReader.class);

    /** Gets each record and when it was there, by {@link System#nanoTime}. */
    interface Arrival {
        void add(ConsumerRecord<byte[], byte[]> record, long nanos);
    }

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Arrival arrival;
    private final Thread thread = new Thread(this::read, "bench-reader");

    RecordReader(Properties client, String topic, Arrival arrival) {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.setProperty("isolation.level", "read_committed");
        properties.setProperty("fetch.min.bytes", Integer.toString(256 * 1024));
        properties.setProperty("fetch.max.wait.ms", "100");
        properties.setProperty("max.poll.records", "5000");
        this.consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        this.arrival = arrival;
        List<TopicPartition> partitions = consumer.partitionsFor(topic).stream()
                .map(info -> new TopicPartition(topic, info.partition()))
                .toList();
        consumer.assign(partitions);
        consumer.seekToEnd(partitions);
        partitions.forEach(consumer::position); // seeks are lazy; from here on nothing is missed
    }

    void start() {
        thread.start();
    }

    private void read() {
        try (consumer) {
            while (true) {
                ConsumerRecords<byte[], byte[]> records = consumer.poll(Duration.ofMillis(200));
                long now = System.nanoTime();
                records.forEach(record -> arrival.add(record, now));
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
