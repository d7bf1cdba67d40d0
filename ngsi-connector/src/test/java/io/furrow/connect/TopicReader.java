package io.furrow.connect;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Set;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.StringDeserializer;

import static org.awaitility.Awaitility.await;

/** Reads whole topics from their beginning, as far as they are committed. */
public final class TopicReader implements AutoCloseable {
    private final KafkaConsumer<String, byte[]> consumer;
    private final List<ConsumerRecord<String, byte[]>> seen = new ArrayList<>();

    public TopicReader(String bootstrapServers, String... topics) {
        Map<String, Object> settings = Map.of(
                "bootstrap.servers",
                bootstrapServers,
                "group.id",
                "reader-" + System.nanoTime(),
                "isolation.level",
                "read_committed",
                "auto.offset.reset",
                "earliest",
                "metadata.max.age.ms",
                "200",
                "max.partition.fetch.bytes",
                20_000_000);
        consumer = new KafkaConsumer<>(settings, new StringDeserializer(), new ByteArrayDeserializer());
        consumer.subscribe(List.of(topics));
    }

    /** All records so far, as soon as there are at least {@code count}. */
    public List<ConsumerRecord<String, byte[]>> atLeast(int count) {
        await().until(() -> {
            consumer.poll(Duration.ofMillis(200)).forEach(seen::add);
            return seen.size() >= count;
        });
        return List.copyOf(seen);
    }

    /** All records up to the end that the topics have now; waits for a topic that is not there yet. */
    public List<ConsumerRecord<String, byte[]>> toTheEnd() {
        await().until(() -> {
            consumer.poll(Duration.ofMillis(200)).forEach(seen::add);
            Set<TopicPartition> partitions = consumer.assignment();
            return !partitions.isEmpty()
                    && consumer.endOffsets(partitions).entrySet().stream()
                            .allMatch(end -> consumer.position(end.getKey()) >= end.getValue());
        });
        return List.copyOf(seen);
    }

    @Override
    public void close() {
        consumer.close();
    }
}
