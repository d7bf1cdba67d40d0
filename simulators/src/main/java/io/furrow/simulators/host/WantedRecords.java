package io.furrow.simulators.host;

import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.locks.LockSupport;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

/**
 * Compacted topics read from their beginning, committed records only: first all that is there by then, newest of each key, then
 * what comes. Topics that are not there yet are waited for.
 */
final class WantedRecords implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(50);
    private static final long LOOK_NANOS = Duration.ofSeconds(1).toNanos();
    private static final long LOOK_AGAIN_NANOS = Duration.ofSeconds(30).toNanos();
    private static final int PATIENCE_MS = 5000;

    private final KafkaConsumer<String, byte[]> consumer;
    private final List<String> topics;
    private final Map<String, Map<String, byte[]>> fresh = new HashMap<>();
    private Map<TopicPartition, Long> ends = new HashMap<>();
    private boolean caughtUp;
    private long nextLook = System.nanoTime();

    /** @param topics of which the first must be there before anything is answered */
    WantedRecords(Properties kafka, List<String> topics) {
        Properties settings = new Properties();
        settings.putAll(kafka);
        settings.put(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_committed");
        settings.put(ConsumerConfig.ALLOW_AUTO_CREATE_TOPICS_CONFIG, false);
        settings.put(ConsumerConfig.ENABLE_AUTO_COMMIT_CONFIG, false);
        settings.put(ConsumerConfig.AUTO_OFFSET_RESET_CONFIG, "earliest");
        settings.putIfAbsent(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, PATIENCE_MS);
        settings.putIfAbsent(ConsumerConfig.REQUEST_TIMEOUT_MS_CONFIG, PATIENCE_MS);
        settings.put(ConsumerConfig.MAX_POLL_RECORDS_CONFIG, 5000);
        this.consumer = new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer());
        this.topics = topics;
    }

    /**
     * What is new since the last time, after a moment at most: per topic the newest value of each key, null of one that was
     * deleted. Empty where there is nothing, or not everything yet that was there at the start.
     */
    Map<String, Map<String, byte[]>> next() {
        lookForPartitions();
        if (consumer.assignment().isEmpty()) {
            LockSupport.parkNanos(POLL.toNanos());
            return Map.of();
        }
        for (ConsumerRecord<String, byte[]> each : consumer.poll(POLL)) {
            if (each.key() != null) {
                Map<String, byte[]> newest = fresh.computeIfAbsent(each.topic(), none -> new LinkedHashMap<>());
                newest.remove(each.key());
                newest.put(each.key(), each.value());
            }
        }
        caughtUp = caughtUp || isAtTheEnd();
        if (!caughtUp) {
            return Map.of();
        }
        Map<String, Map<String, byte[]>> all = Map.copyOf(fresh);
        fresh.clear();
        return all;
    }

    /** Whether all that was there at the start has been answered. */
    boolean isCaughtUp() {
        return caughtUp;
    }

    private boolean isAtTheEnd() {
        return !ends.isEmpty()
                && ends.entrySet().stream().allMatch(end -> consumer.position(end.getKey()) >= end.getValue());
    }

    /** A topic may be made, or get more partitions, at any time. */
    private void lookForPartitions() {
        if (System.nanoTime() - nextLook < 0) {
            return;
        }
        boolean complete = true;
        Set<TopicPartition> known = new HashSet<>();
        for (String topic : topics) {
            List<PartitionInfo> partitions = consumer.partitionsFor(topic);
            complete &= !partitions.isEmpty();
            partitions.forEach(each -> known.add(new TopicPartition(topic, each.partition())));
        }
        nextLook = System.nanoTime() + (complete ? LOOK_AGAIN_NANOS : LOOK_NANOS);
        Set<TopicPartition> added = new HashSet<>(known);
        added.removeAll(consumer.assignment());
        if (added.isEmpty()) {
            return;
        }
        consumer.assign(known);
        consumer.seekToBeginning(added);
        if (!caughtUp && known.stream().anyMatch(each -> each.topic().equals(topics.get(0)))) {
            ends = consumer.endOffsets(known);
        }
    }

    @Override
    public void close() {
        consumer.close();
    }
}
