package io.furrow.soak;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.LongStream;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;

import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Reads all committed records of a topic from the beginning; each read adds the new ones. */
public final class TopicLog implements AutoCloseable {
    private final KafkaConsumer<String, byte[]> consumer;
    private final List<Entity> entities = new ArrayList<>();
    private final List<Long> ingestTimes = new ArrayList<>();

    public TopicLog(String bootstrapServers, String topic) {
        consumer = CommittedState.consumer(bootstrapServers);
        CommittedState.assign(consumer, List.of(topic));
    }

    /** The number of records of topics with these suffixes, including transaction markers. */
    static long count(String bootstrapServers, List<String> suffixes) {
        try (TopicLog any = new TopicLog(bootstrapServers, Topics.RAW)) {
            List<String> topics = any.consumer.listTopics().keySet().stream()
                    .filter(topic -> suffixes.stream().anyMatch(topic::endsWith))
                    .toList();
            List<TopicPartition> partitions = CommittedState.partitions(any.consumer, topics);
            return any.consumer.endOffsets(partitions).values().stream()
                    .mapToLong(Long::longValue)
                    .sum();
        }
    }

    /** Reads for a duration, and at least to the end offsets at the start of the call. */
    public List<Entity> read(Duration duration) throws UnreadableException {
        var ends = consumer.endOffsets(consumer.assignment());
        long until = System.nanoTime() + duration.toNanos();
        while (System.nanoTime() < until
                || ends.entrySet().stream().anyMatch(end -> consumer.position(end.getKey()) < end.getValue())) {
            for (ConsumerRecord<String, byte[]> record : consumer.poll(Duration.ofMillis(100))) {
                entities.add(Entity.parse(record.value()));
                Header ingested = record.headers().lastHeader(HeaderNames.TS_INGEST);
                if (ingested != null) {
                    ingestTimes.add(Long.parseLong(new String(ingested.value(), UTF_8)));
                }
            }
        }
        return List.copyOf(entities);
    }

    /** The longest time in which ingest wrote nothing, ms. */
    long maxSilence() {
        long[] times = ingestTimes.stream().mapToLong(Long::longValue).sorted().toArray();
        return LongStream.range(1, times.length)
                .map(i -> times[(int) i] - times[(int) i - 1])
                .max()
                .orElse(0);
    }

    @Override
    public void close() {
        consumer.close();
    }
}
