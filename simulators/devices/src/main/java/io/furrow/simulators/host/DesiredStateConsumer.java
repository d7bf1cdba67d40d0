package io.furrow.simulators.host;

import java.time.Duration;
import java.util.HashMap;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.kafka.CommittedReader;

/**
 * Reads compacted topics from their beginning, committed records only: first the newest of each key up to the current
 * end, then new records. Waits for topics that do not exist yet.
 */
final class DesiredStateConsumer implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(50);
    private static final long POLL_INTERVAL_NANOS = Duration.ofSeconds(1).toNanos();
    private static final long REFRESH_INTERVAL_NANOS = Duration.ofSeconds(30).toNanos();
    private static final int TIMEOUT_MS = 5000;

    private final CommittedReader<String> reader;
    private final List<String> topics;
    private final Map<String, Map<String, byte[]>> fresh = new HashMap<>();
    private boolean caughtUp;
    private long nextDiscovery = System.nanoTime();

    /** @param topics of which the first must exist before anything is returned */
    DesiredStateConsumer(Properties kafka, List<String> topics) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.putIfAbsent(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, TIMEOUT_MS);
        settings.putIfAbsent(ConsumerConfig.REQUEST_TIMEOUT_MS_CONFIG, TIMEOUT_MS);
        settings.put(ConsumerConfig.MAX_POLL_RECORDS_CONFIG, 5000);
        this.reader = CommittedReader.unassigned(settings);
        this.topics = topics;
    }

    /**
     * Waits a moment for new records.
     *
     * @return per topic the newest value of each key, null if deleted; empty until everything that existed at the start
     *     is read
     */
    Map<String, Map<String, byte[]>> next() {
        discoverPartitions();
        if (!reader.isAssigned(topics.get(0))) {
            LockSupport.parkNanos(POLL.toNanos());
            return Map.of();
        }
        for (ConsumerRecord<String, byte[]> each : reader.poll(POLL)) {
            if (each.key() != null) {
                Map<String, byte[]> newest = fresh.computeIfAbsent(each.topic(), none -> new LinkedHashMap<>());
                newest.remove(each.key());
                newest.put(each.key(), each.value());
            }
        }
        caughtUp = caughtUp || reader.isCaughtUp();
        if (!caughtUp) {
            return Map.of();
        }
        Map<String, Map<String, byte[]>> all = Map.copyOf(fresh);
        fresh.clear();
        return all;
    }

    /** Whether all records that existed at the start have been returned. */
    boolean isCaughtUp() {
        return caughtUp;
    }

    /** Topics may be created, or get more partitions, at any time. */
    private void discoverPartitions() {
        if (System.nanoTime() - nextDiscovery >= 0) {
            boolean complete = reader.assign(topics);
            nextDiscovery = System.nanoTime() + (complete ? REFRESH_INTERVAL_NANOS : POLL_INTERVAL_NANOS);
        }
    }

    @Override
    public void close() {
        reader.close();
    }
}
