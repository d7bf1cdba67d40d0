package io.furrow.bench.frame;

import java.util.Collection;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;

/** A producer that fails at the end if a record was not written. */
public final class TopicFiller implements AutoCloseable {
    private final AtomicReference<Exception> failure = new AtomicReference<>();
    private final KafkaProducer<byte[], byte[]> producer;

    /** @param settings in addition to those of the client */
    public TopicFiller(Properties client, Map<String, String> settings) {
        Properties all = new Properties();
        all.putAll(client);
        // With more, the first batch to a partition that is being created can be overtaken and is then refused forever.
        all.setProperty("max.in.flight.requests.per.connection", "1");
        all.putAll(settings);
        producer = new KafkaProducer<>(all, new ByteArraySerializer(), new ByteArraySerializer());
    }

    public TopicFiller(KafkaProducer<byte[], byte[]> producer) {
        this.producer = producer;
    }

    /** Fetches the partitions of topics before the first record. */
    public void learn(Collection<String> topics) {
        topics.forEach(producer::partitionsFor);
    }

    public void send(ProducerRecord<byte[], byte[]> record) {
        producer.send(record, (done, failed) -> failure.compareAndSet(null, failed));
    }

    /** Waits until all records are written. @throws IllegalStateException if one was not */
    public void flush() {
        producer.flush();
        check();
    }

    private void check() {
        if (failure.get() != null) {
            throw new IllegalStateException("a record was not written", failure.get());
        }
    }

    @Override
    public void close() {
        producer.close();
        check();
    }
}
