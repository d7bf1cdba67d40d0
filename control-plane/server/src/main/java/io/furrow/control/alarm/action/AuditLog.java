package io.furrow.control.alarm.action;

import java.time.Duration;
import java.util.Properties;
import java.util.concurrent.ArrayBlockingQueue;
import java.util.concurrent.RejectedExecutionException;
import java.util.concurrent.ThreadPoolExecutor;
import java.util.concurrent.TimeUnit;
import java.util.function.Consumer;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.KafkaException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.audit.AuditEntry;
import io.furrow.kafka.DaemonThreads;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.topic.Topics;

/**
 * Writes audit entries to {@code service.audit} from its own thread, so that the caller never waits for Kafka. An entry
 * that cannot be written is logged.
 */
final class AuditLog implements Consumer<AuditEntry>, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(AuditLog.class);
    private static final int MAX_WAITING = 10_000;
    private static final Duration CLOSE_TIMEOUT = Duration.ofSeconds(5);

    private final KafkaProducer<String, byte[]> producer;
    private final ThreadPoolExecutor writer = new ThreadPoolExecutor(
            1,
            1,
            0,
            TimeUnit.SECONDS,
            new ArrayBlockingQueue<>(MAX_WAITING),
            task -> new Thread(task, "furrow-stop-audit"));

    AuditLog(Properties client) {
        producer = KafkaClients.producer(client);
    }

    @Override
    public void accept(AuditEntry entry) {
        try {
            writer.execute(() -> write(entry));
        } catch (RejectedExecutionException e) {
            failed(entry, e);
        }
    }

    private void write(AuditEntry entry) {
        try {
            producer.send(new ProducerRecord<>(Topics.AUDIT, entry.toBytes()), (written, failure) -> {
                if (failure != null) {
                    failed(entry, failure);
                }
            });
        } catch (KafkaException e) {
            failed(entry, e);
        }
    }

    private static void failed(AuditEntry entry, Exception failure) {
        LOG.error(
                "audit entry was not written to the audit topic: {} {}, {}",
                entry.command(),
                entry.about(),
                entry.result(),
                failure);
    }

    @Override
    public void close() {
        writer.shutdown();
        DaemonThreads.await(writer, CLOSE_TIMEOUT);
        producer.close(CLOSE_TIMEOUT);
    }
}
