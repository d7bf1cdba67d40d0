package io.furrow.bench.notifications;

import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.atomic.LongAdder;
import java.util.function.IntFunction;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

/**
 * Measures the maximum rate at which one producer writes such records, with the settings of a Connect worker's producers:
 * all replicas acknowledge, one request in flight per broker.
 */
public final class BaselineProducer {
    private BaselineProducer() {}

    /** Acknowledged records per second. */
    public static double perSecond(
            Properties client, IntFunction<ProducerRecord<byte[], byte[]>> records, Duration duration) {
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
                producer.send(records.apply(i), (metadata, failure) -> {
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
