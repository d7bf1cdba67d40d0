package io.furrow.soak.source;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.function.Consumer;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;

import io.furrow.model.topic.Topics;
import io.furrow.soak.CommittedState;

/** Reads the committed records of {@code data.raw} from the beginning. */
final class CommittedRecords implements AutoCloseable {
    private final String bootstrapServers;
    private final KafkaConsumer<String, byte[]> consumer;

    CommittedRecords(String bootstrapServers) {
        this.bootstrapServers = bootstrapServers;
        consumer = CommittedState.consumer(bootstrapServers);
        CommittedState.assign(consumer, List.of(Topics.RAW));
    }

    /** Reads to the current end of the topic, and waits for transactions that are about to end. */
    void read(Consumer<ConsumerRecord<String, byte[]>> reader) {
        Map<TopicPartition, Long> ends = endsWithOpenTransactions();
        long deadline = System.nanoTime() + Duration.ofSeconds(120).toNanos();
        while (ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            if (System.nanoTime() > deadline) {
                throw new IllegalStateException("the topic cannot be read to its end: a transaction is open");
            }
            consumer.poll(Duration.ofMillis(100)).forEach(reader);
        }
    }

    private Map<TopicPartition, Long> endsWithOpenTransactions() {
        try (var uncommitted = CommittedState.consumer(bootstrapServers, "read_uncommitted")) {
            return uncommitted.endOffsets(consumer.assignment());
        }
    }

    @Override
    public void close() {
        consumer.close();
    }
}
