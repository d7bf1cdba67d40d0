package io.furrow.control.rest.view;

import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.Semaphore;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.function.BooleanSupplier;

import org.apache.kafka.clients.producer.Producer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.kafka.DaemonThreads;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.Limits;

/**
 * Sends records to Kafka on its own thread, so that callers never block in a producer. The queue is bounded in records
 * and bytes; beyond that a {@link ProblemException} asks to retry.
 */
final class RecordSender implements AutoCloseable {
    private static final int MAX_RECORDS = 1000;
    private static final int MAX_BYTES = 16 * 1024 * 1024;
    private static final Duration MAX_BLOCK = Duration.ofSeconds(2);
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(5);

    private final Producer<String, byte[]> producer;
    private final Semaphore bytes = new Semaphore(MAX_BYTES);
    private final ThreadPoolExecutor executor = DaemonThreads.single("control-plane-rest-sender", MAX_RECORDS);

    /** @param timeout after which an unacknowledged record fails */
    RecordSender(Properties client, Duration timeout) {
        Properties settings = new Properties();
        settings.putAll(client);
        settings.put("max.block.ms", Long.toString(Math.min(MAX_BLOCK.toMillis(), timeout.toMillis())));
        settings.put("request.timeout.ms", Long.toString(timeout.toMillis()));
        settings.put("delivery.timeout.ms", Long.toString(timeout.toMillis()));
        settings.put("linger.ms", "0");
        settings.put("max.request.size", Integer.toString(Limits.MESSAGE_BYTES));
        this.producer = KafkaClients.producer(settings);
    }

    /**
     * Sends a record, unless it is no longer needed when its turn comes.
     *
     * @return completes once Kafka has acknowledged it
     * @throws ProblemException if the queue is full
     */
    CompletableFuture<Void> send(ProducerRecord<String, byte[]> record, BooleanSupplier isNeeded) {
        int size = record.value().length;
        if (!bytes.tryAcquire(size)) {
            throw ProblemException.overloaded();
        }
        CompletableFuture<Void> sent = new CompletableFuture<>();
        sent.whenComplete((done, failure) -> bytes.release(size));
        try {
            executor.execute(() -> send(record, isNeeded, sent));
        } catch (RejectedExecutionException e) {
            sent.cancel(false);
            throw ProblemException.overloaded();
        }
        return sent;
    }

    private void send(ProducerRecord<String, byte[]> record, BooleanSupplier isNeeded, CompletableFuture<Void> sent) {
        if (!isNeeded.getAsBoolean()) {
            sent.cancel(false);
            return;
        }
        try {
            producer.send(record, (at, failure) -> {
                if (failure == null) {
                    sent.complete(null);
                } else {
                    sent.completeExceptionally(failure);
                }
            });
        } catch (KafkaException e) {
            sent.completeExceptionally(e);
        }
    }

    @Override
    public void close() {
        executor.shutdown();
        producer.close(CLOSE_TIMEOUT);
        executor.shutdownNow();
    }
}
