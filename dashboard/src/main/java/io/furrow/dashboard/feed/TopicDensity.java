package io.furrow.dashboard.feed;

import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.concurrent.TimeoutException;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.ListOffsetsResult.ListOffsetsResultInfo;
import org.apache.kafka.clients.admin.OffsetSpec;
import org.apache.kafka.clients.admin.TopicDescription;
import org.apache.kafka.common.KafkaFuture;
import org.apache.kafka.common.TopicPartition;

/**
 * Counts the records of a topic per bucket of time without reading them: Kafka's time index has the offset at which a
 * bucket begins, and the difference of two offsets is the number of records. Offsets of past buckets are cached, and
 * requests run one after the other, so each offset is requested once.
 */
public final class TopicDensity {
    public static final int MAX_BUCKETS = 400;
    private static final Duration TIMEOUT = Duration.ofSeconds(15);
    /**
     * Records are not strictly in the order of their timestamps, so the first offset of a bucket is final only after
     * this time.
     */
    private static final long FINAL_AFTER_MS = 60_000;

    private static final int MAX_CACHED = 20_000;

    private final Admin admin;
    private final Map<BucketStart, Long> cached = new HashMap<>();

    private record BucketStart(String topic, long time) {}

    public TopicDensity(Admin admin) {
        this.admin = admin;
    }

    /**
     * Counts the records of each bucket.
     *
     * @param from start of the first bucket, epoch ms
     * @param width of a bucket, ms
     * @throws ExecutionException if Kafka fails
     * @throws TimeoutException if Kafka does not respond within 15 s
     */
    public synchronized List<Long> count(String topic, long from, long width, int buckets)
            throws InterruptedException, ExecutionException, TimeoutException {
        TreeMap<Long, Long> offsets = new TreeMap<>();
        Set<Long> missing = new HashSet<>();
        for (long time = from, i = 0; i <= buckets; time += width, i++) {
            Long existing = cached.get(new BucketStart(topic, time));
            if (existing == null) {
                missing.add(time);
            } else {
                offsets.put(time, existing);
            }
        }
        request(topic, missing, offsets);
        List<Long> counts = new ArrayList<>(buckets);
        for (int i = 0; i < buckets; i++) {
            counts.add(Math.max(0, offsets.get(from + (i + 1) * width) - offsets.get(from + i * width)));
        }
        return counts;
    }

    /** Adds, for each time, the sum of the offsets of all partitions. */
    private void request(String topic, Set<Long> times, Map<Long, Long> offsets)
            throws InterruptedException, ExecutionException, TimeoutException {
        if (times.isEmpty()) {
            return;
        }
        long deadline = System.nanoTime() + TIMEOUT.toNanos();
        TopicDescription description =
                answer(admin.describeTopics(List.of(topic)).topicNameValues().get(topic), deadline);
        List<TopicPartition> partitions = description.partitions().stream()
                .map(each -> new TopicPartition(topic, each.partition()))
                .toList();
        long now = System.currentTimeMillis();
        KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> ends = list(partitions, OffsetSpec.latest());
        Map<Long, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>>> starts = new HashMap<>();
        times.forEach(time -> starts.put(time, list(partitions, OffsetSpec.forTimestamp(time))));
        if (cached.size() > MAX_CACHED) {
            cached.clear();
        }
        for (Map.Entry<Long, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>>> each : starts.entrySet()) {
            Map<TopicPartition, ListOffsetsResultInfo> found = answer(each.getValue(), deadline);
            long sum = 0;
            for (TopicPartition partition : partitions) {
                long offset = found.get(partition).offset();
                // without a later record, the bucket begins at the end of the partition
                sum += offset >= 0
                        ? offset
                        : answer(ends, deadline).get(partition).offset();
            }
            offsets.put(each.getKey(), sum);
            if (each.getKey() < now - FINAL_AFTER_MS) {
                cached.put(new BucketStart(topic, each.getKey()), sum);
            }
        }
    }

    private KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> list(
            List<TopicPartition> partitions, OffsetSpec spec) {
        Map<TopicPartition, OffsetSpec> specs = new HashMap<>();
        partitions.forEach(each -> specs.put(each, spec));
        return admin.listOffsets(specs).all();
    }

    private static <T> T answer(KafkaFuture<T> future, long deadline)
            throws InterruptedException, ExecutionException, TimeoutException {
        return future.get(Math.max(0, deadline - System.nanoTime()), TimeUnit.NANOSECONDS);
    }
}
