package io.furrow.bench.analytics;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ConcurrentHashMap;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.WakeupException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.bench.analytics.load.CrowdedFleet;
import io.furrow.bench.analytics.load.FleetTopic;

/** Follows what is found of a crowd and of the fleet beside it. */
final class CrowdReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(CrowdReader.class);
    private static final String STARTED = "\"started\"";
    /** Of event time: what came at the end may not be found yet. */
    private static final long OPEN_SECONDS = 4;

    private final FleetTopic topic;
    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Thread thread = new Thread(this::read, "bench-crowd");
    /** Encounters of the fleet by the second in which they start. */
    private final Map<Long, Integer> starts = new ConcurrentHashMap<>();

    private final List<String> overflows = Collections.synchronizedList(new ArrayList<>());
    private volatile long newestOfCrowd;
    private volatile long newestOfFleet;
    private volatile long count;

    CrowdReader(Properties kafka, FleetTopic topic) {
        this.topic = topic;
        Properties properties = new Properties();
        properties.putAll(kafka);
        consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
        List<TopicPartition> partitions = Stream.of(topic.results(), topic.overflows())
                .flatMap(name -> IntStream.range(0, FleetTopic.PARTITIONS)
                        .mapToObj(partition -> new TopicPartition(name, partition)))
                .toList();
        consumer.assign(partitions);
        consumer.seekToBeginning(partitions);
        thread.start();
    }

    /** How far the newest result of the crowd, or of the fleet, is behind the clock, in milliseconds. */
    long lag() {
        long oldest = Math.min(newestOfCrowd, newestOfFleet);
        return System.currentTimeMillis() - Math.max(oldest, topic.begin());
    }

    long count() {
        return count;
    }

    /** What was found by now; the fleet's starts are compared with those of the bare loop. */
    SustainedCrowd held(SustainedCrowd.Plan plan, int others, List<Long> lags) {
        BaselineLoop loop = new BaselineLoop(others, CrowdedFleet::told);
        int compared = (int) Math.max(0, (newestOfFleet - topic.begin()) / 1000 - OPEN_SECONDS);
        int different = 0;
        for (long second = 0; second < compared; second++) {
            different += loop.second(second) == starts.getOrDefault(second, 0) ? 0 : 1;
        }
        return new SustainedCrowd(plan, others, lags, count, List.copyOf(overflows), compared, different);
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread reads
    private void read() {
        try (consumer) {
            while (true) {
                for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(200))) {
                    take(record);
                }
            }
        } catch (WakeupException e) {
            LOG.debug("closed", e);
        }
    }

    @SuppressWarnings("NonAtomicOperationOnVolatileField") // one thread reads
    private void take(ConsumerRecord<byte[], byte[]> record) {
        if (record.topic().equals(topic.overflows())) {
            overflows.add(new String(record.value(), StandardCharsets.UTF_8));
            return;
        }
        count++;
        String key = new String(record.key(), StandardCharsets.UTF_8);
        if (key.contains(CrowdedFleet.CROWD)) {
            newestOfCrowd = Math.max(newestOfCrowd, record.timestamp());
            return;
        }
        newestOfFleet = Math.max(newestOfFleet, record.timestamp());
        if (new String(record.value(), StandardCharsets.UTF_8).contains(STARTED)) {
            starts.merge((record.timestamp() - topic.begin()) / 1000, 1, Integer::sum);
        }
    }

    @Override
    public void close() {
        consumer.wakeup();
        try {
            thread.join();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
