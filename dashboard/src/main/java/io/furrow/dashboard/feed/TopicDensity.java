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
 * How many records a topic has in each bucket of a stretch of time. No record is read: Kafka's index of times says at which offset a bucket
 * begins, and a bucket has as many records as lie between two of them. Begins that are past are remembered, and who asks waits for who asked
 * before, so that each is asked for once.
 */
public final class TopicDensity {
    public static final int MAX_BUCKETS = 400;
    private static final Duration TIMEOUT = Duration.ofSeconds(15);
    /** Records are not strictly in the order of their timestamps, so the begin of a bucket is final only then. */
    private static final long SETTLED_MS = 60_000;

    private static final int REMEMBERED = 20_000;

    private final Admin admin;
    private final Map<Begin, Long> settled = new HashMap<>();

    private record Begin(String topic, long time) {}

    public TopicDensity(Admin admin) {
        this.admin = admin;
    }

    /**
     * @param from epoch ms, of the first bucket's begin
     * @param width of a bucket, ms
     * @return the number of records of each bucket
     * @throws ExecutionException of Kafka
     * @throws TimeoutException where it does not answer within 15 s
     */
    public synchronized List<Long> count(String topic, long from, long width, int buckets)
            throws InterruptedException, ExecutionException, TimeoutException {
        TreeMap<Long, Long> offsets = new TreeMap<>();
        Set<Long> unknown = new HashSet<>();
        for (long time = from, i = 0; i <= buckets; time += width, i++) {
            Long existing = settled.get(new Begin(topic, time));
            if (existing == null) {
                unknown.add(time);
            } else {
                offsets.put(time, existing);
            }
        }
        request(topic, unknown, offsets);
        List<Long> counts = new ArrayList<>(buckets);
        for (int i = 0; i < buckets; i++) {
            counts.add(Math.max(0, offsets.get(from + (i + 1) * width) - offsets.get(from + i * width)));
        }
        return counts;
    }

    /** Sums over the partitions of a topic. */
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
        Map<Long, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>>> begins = new HashMap<>();
        times.forEach(time -> begins.put(time, list(partitions, OffsetSpec.forTimestamp(time))));
        if (settled.size() > REMEMBERED) {
            settled.clear();
        }
        for (Map.Entry<Long, KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>>> each : begins.entrySet()) {
            Map<TopicPartition, ListOffsetsResultInfo> found = answer(each.getValue(), deadline);
            long sum = 0;
            for (TopicPartition partition : partitions) {
                long offset = found.get(partition).offset();
                // none is as late: it begins where the topic ends
                sum += offset >= 0
                        ? offset
                        : answer(ends, deadline).get(partition).offset();
            }
            offsets.put(each.getKey(), sum);
            if (each.getKey() < now - SETTLED_MS) {
                settled.put(new Begin(topic, each.getKey()), sum);
            }
        }
    }

    private KafkaFuture<Map<TopicPartition, ListOffsetsResultInfo>> list(List<TopicPartition> of, OffsetSpec spec) {
        Map<TopicPartition, OffsetSpec> desired = new HashMap<>();
        of.forEach(each -> desired.put(each, spec));
        return admin.listOffsets(desired).all();
    }

    private static <T> T answer(KafkaFuture<T> future, long deadline)
            throws InterruptedException, ExecutionException, TimeoutException {
        return future.get(Math.max(0, deadline - System.nanoTime()), TimeUnit.NANOSECONDS);
    }
}
