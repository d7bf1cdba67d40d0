package io.furrow.soak.control;

import java.net.URI;
import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;

import io.furrow.model.control.Limits;

/** Sends a request once, over the REST API or over Kafka; the caller repeats the same request if there is no answer. */
final class RequestSender implements AutoCloseable {
    private static final String SEND_TIMEOUT_MS = "10000";
    private static final long PAUSE_MS = 500;
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(5);

    private final KafkaProducer<String, byte[]> producer;

    RequestSender(String bootstrapServers) {
        Properties settings = new Properties();
        settings.setProperty("bootstrap.servers", bootstrapServers);
        settings.setProperty("max.request.size", Integer.toString(Limits.MESSAGE_BYTES));
        settings.setProperty("max.block.ms", SEND_TIMEOUT_MS);
        settings.setProperty("request.timeout.ms", SEND_TIMEOUT_MS);
        settings.setProperty("delivery.timeout.ms", SEND_TIMEOUT_MS);
        settings.setProperty("linger.ms", "0");
        producer = new KafkaProducer<>(settings, new StringSerializer(), new ByteArraySerializer());
    }

    /** Sends over the API; status 0 without a response. */
    CompletableFuture<Http.Answer> call(URI api, ControlRequest request) {
        ControlRequest.Call call = request.toCall();
        return Http.send(call.method(), api.resolve(call.path()), call.body(), "Idempotency-Key", request.id());
    }

    /** Sends over the topic. The answer is a record of the same topic. */
    void write(ControlRequest request) {
        write(request.topic(), request.id(), request.toBytes());
    }

    /** Writes any record. */
    void write(String topic, String key, byte[] value) {
        producer.send(new ProducerRecord<>(topic, key, value));
    }

    void write(ProducerRecord<String, byte[]> record) {
        producer.send(record);
    }

    /**
     * Returns once Kafka has acknowledged the record, after any number of outages; the record may be written several
     * times.
     */
    void writeWithRetry(ProducerRecord<String, byte[]> record) throws InterruptedException {
        while (true) {
            try {
                producer.send(record).get();
                return;
            } catch (ExecutionException | KafkaException e) {
                Thread.sleep(PAUSE_MS);
            }
        }
    }

    void flush() {
        producer.flush();
    }

    @Override
    public void close() {
        producer.close(CLOSE_TIMEOUT);
    }
}
