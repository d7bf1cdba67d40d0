package io.furrow.control.rest.view;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Semaphore;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.consumer.Consumer;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.Topics;

/** Reads the audit topic backwards from Kafka, for at most {@value #MAX_CONCURRENT} requests at once. */
public final class AuditHistory {
    /** Maximum number of records that one request reads. */
    public static final int MAX_READ = 20_000;

    private static final int MAX_CONCURRENT = 2;
    private static final int STEP = 2_000;
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration TIMEOUT = Duration.ofSeconds(5);
    private static final TopicPartition AUDIT = new TopicPartition(Topics.AUDIT, 0);

    private final Properties settings = new Properties();
    private final Semaphore free = new Semaphore(MAX_CONCURRENT);

    /**
     * A page of entries, the newest first.
     *
     * @param next exclusive upper bound of the next page; negative if there is no older entry
     */
    public record Page(List<AuditedEntry> entries, long next) {}

    /** @param client settings of a Kafka client */
    public AuditHistory(Properties client) {
        settings.putAll(CommittedReader.boundedSettings(client));
        settings.put("default.api.timeout.ms", Long.toString(TIMEOUT.toMillis()));
    }

    /**
     * Returns the newest entries before a position. Because the number of records per request is limited, a page may
     * have fewer entries than requested, or none, and still a next page.
     *
     * @throws ProblemException if Kafka is unavailable or too many requests are running
     */
    public Page read(long before, int limit, Predicate<AuditedEntry> desired) {
        if (!free.tryAcquire()) {
            throw ProblemException.overloaded();
        }
        try (Consumer<String, byte[]> consumer = KafkaClients.consumer(settings)) {
            return read(consumer, before, limit, desired);
        } catch (KafkaException e) {
            throw new ProblemException(
                    503,
                    "kafka-away",
                    "the audit topic cannot be read (%s); check that Kafka runs".formatted(FailureText.of(e)));
        } finally {
            free.release();
        }
    }

    private static Page read(
            Consumer<String, byte[]> consumer, long before, int limit, Predicate<AuditedEntry> desired) {
        consumer.assign(List.of(AUDIT));
        long first = consumer.beginningOffsets(List.of(AUDIT)).get(AUDIT);
        long end = Math.min(before, consumer.endOffsets(List.of(AUDIT)).get(AUDIT));
        long minimum = Math.max(first, end - MAX_READ);
        long deadline = System.nanoTime() + TIMEOUT.toNanos();
        List<AuditedEntry> found = new ArrayList<>();
        while (end > minimum && System.nanoTime() < deadline) {
            long start = Math.max(minimum, end - STEP);
            List<AuditedEntry> step = step(consumer, start, end, deadline);
            for (int i = step.size() - 1; i >= 0; i--) {
                if (desired.test(step.get(i))) {
                    found.add(step.get(i));
                    if (found.size() == limit) {
                        long position = step.get(i).position();
                        return new Page(found, position > first ? position : -1);
                    }
                }
            }
            end = start;
        }
        return new Page(found, end > first ? end : -1);
    }

    /**
     * Returns the entries of an offset range, the oldest first. Aborted records and transaction markers have offsets
     * but are not entries.
     */
    private static List<AuditedEntry> step(Consumer<String, byte[]> consumer, long start, long end, long deadline) {
        List<AuditedEntry> entries = new ArrayList<>();
        consumer.seek(AUDIT, start);
        while (consumer.position(AUDIT) < end) {
            if (System.nanoTime() > deadline) {
                throw new org.apache.kafka.common.errors.TimeoutException("not read within " + TIMEOUT);
            }
            for (ConsumerRecord<String, byte[]> record : consumer.poll(POLL)) {
                ObjectNode value = entry(record.value());
                if (record.offset() < end && value != null) {
                    entries.add(new AuditedEntry(record.offset(), value));
                }
            }
        }
        return entries;
    }

    /** Parses an entry; null if it is invalid. */
    private static ObjectNode entry(byte[] value) {
        try {
            return value != null && NgsiJson.read(value) instanceof ObjectNode object ? object : null;
        } catch (UnreadableException e) {
            return null;
        }
    }
}
