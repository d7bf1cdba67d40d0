package io.furrow.bench.notifications;

import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.atomic.LongAdder;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

/**
 * The rate at which one producer writes records like these, as fast as it can, with the settings that a Connect worker gives
 * to its producers: all replicas acknowledge, one request at a time to each broker.
 */
public final class BaselineProducer {
    private final Properties client;
    private final String topic;

    public BaselineProducer(Properties client, String topic) {
        this.client = client;
        this.topic = topic;
    }

    /** Acknowledged records per second. */
    public double perSecond(List<ConsumerRecord<byte[], byte[]>> samples, Duration duration) {
        Properties properties = new Properties();
        properties.putAll(client);
        properties.setProperty("acks", "all");
        properties.setProperty("enable.idempotence", "false");
        properties.setProperty("max.in.flight.requests.per.connection", "1");
        properties.setProperty("max.request.size", Integer.toString(16 * 1024 * 1024));
        LongAdder acknowledged = new LongAdder();
        try (KafkaProducer<byte[], byte[]> producer =
                new KafkaProducer<>(properties, new ByteArraySerializer(), new ByteArraySerializer())) {
            long start = System.nanoTime();
            for (int i = 0; System.nanoTime() - start < duration.toNanos(); i++) {
                ConsumerRecord<byte[], byte[]> sample = samples.get(i % samples.size());
                producer.send(
                        new ProducerRecord<>(
                                topic, null, sample.timestamp(), sample.key(), sample.value(), sample.headers()),
                        (metadata, failure) -> {
                            if (failure == null) {
                                acknowledged.increment();
                            }
                        });
            }
            producer.flush();
            return acknowledged.sum() * 1e9 / (System.nanoTime() - start);
        }
    }
}
