package io.furrow.cli.compare;

import java.time.Duration;
import java.util.Collection;
import java.util.EnumMap;
import java.util.EnumSet;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.Properties;
import java.util.Set;
import java.util.function.Consumer;
import java.util.stream.IntStream;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.cli.option.CommandException;
import io.furrow.kafka.CommittedReader;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Reads results from the beginning of their topics to the end offsets at the start of the read; committed records only. */
final class ResultReader implements AutoCloseable {
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration TIMEOUT = Duration.ofSeconds(20);
    /** Several, because the last offsets of a partition may be a transaction's markers. */
    private static final int LAST_RECORDS = 50;

    private final KafkaConsumer<byte[], byte[]> consumer;
    /** By topic. */
    private final Map<String, Integer> partitions = new HashMap<>();

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    ResultReader(Properties client) {
        Properties properties = CommittedReader.boundedSettings(client);
        properties.setProperty(ConsumerConfig.DEFAULT_API_TIMEOUT_MS_CONFIG, Long.toString(TIMEOUT.toMillis()));
        try {
            consumer = new KafkaConsumer<>(properties, new ByteArrayDeserializer(), new ByteArrayDeserializer());
            consumer.listTopics().forEach((topic, all) -> partitions.put(topic, all.size()));
        } catch (KafkaException e) {
            throw new CommandException(
                    "Kafka at %s cannot be read (%s). Check the address given with --kafka."
                            .formatted(client.getProperty("bootstrap.servers"), FailureText.of(e)),
                    e);
        }
    }

    /** Names of all topics. */
    Collection<String> topics() {
        return Set.copyOf(partitions.keySet());
    }

    /**
     * @param desired epoch of a replay; empty for its newest
     * @param mission see {@link ResultCollector}
     * @throws CommandException if a record is not an entity, or Kafka does not answer
     */
    SideResults read(Side side, OptionalLong desired, String mission) {
        try {
            OptionalLong epoch = side.isLive() ? OptionalLong.of(0) : desired.isPresent() ? desired : newestEpoch(side);
            ResultCollector collector = new ResultCollector(mission);
            Set<ResultKind> missing = EnumSet.noneOf(ResultKind.class);
            for (ResultKind kind : ResultKind.values()) {
                if (partitions.containsKey(side.results(kind))) {
                    read(side, kind, epoch, collector);
                } else {
                    missing.add(kind);
                }
            }
            Map<ResultKind, List<AnalyticsResult>> spans = new EnumMap<>(ResultKind.class);
            for (ResultKind kind : ResultKind.values()) {
                spans.put(kind, collector.spans(kind));
            }
            return new SideResults(side.name(), epoch.orElse(collector.epoch()), spans, missing);
        } catch (KafkaException e) {
            throw new CommandException(
                    "The results of %s cannot be read: %s".formatted(side.name(), FailureText.of(e)), e);
        }
    }

    private void read(Side side, ResultKind kind, OptionalLong epoch, ResultCollector collector) {
        List<TopicPartition> all = assign(side.results(kind));
        consumer.seekToBeginning(all);
        toEnd(all, record -> {
            long ofEpoch = side.isLive() ? 0 : epoch(record);
            if (record.value() != null && (epoch.isEmpty() || epoch.getAsLong() == ofEpoch)) {
                collector.add(kind, ofEpoch, scope(record), entity(record));
            }
        });
    }

    /** The epoch of the last replayed record: an epoch may be without results. */
    private OptionalLong newestEpoch(Side side) {
        if (!partitions.containsKey(side.topic())) {
            return OptionalLong.empty();
        }
        List<TopicPartition> all = assign(side.topic());
        Map<TopicPartition, Long> begins = consumer.beginningOffsets(all);
        consumer.endOffsets(all)
                .forEach((one, end) -> consumer.seek(one, Math.max(begins.get(one), end - LAST_RECORDS)));
        long[] newest = {-1};
        toEnd(all, record -> newest[0] = Math.max(newest[0], epoch(record)));
        return newest[0] < 0 ? OptionalLong.empty() : OptionalLong.of(newest[0]);
    }

    private List<TopicPartition> assign(String topic) {
        List<TopicPartition> all = IntStream.range(0, partitions.get(topic))
                .mapToObj(number -> new TopicPartition(topic, number))
                .toList();
        consumer.assign(all);
        return all;
    }

    private static Entity entity(ConsumerRecord<byte[], byte[]> record) {
        try {
            return Entity.parse(record.value());
        } catch (UnreadableException e) {
            throw new CommandException(
                    "%s-%d@%d is not an entity: %s. Check who else writes to the topic."
                            .formatted(record.topic(), record.partition(), record.offset(), e.getMessage()),
                    e);
        }
    }

    private void toEnd(List<TopicPartition> all, Consumer<ConsumerRecord<byte[], byte[]>> reader) {
        Map<TopicPartition, Long> ends = consumer.endOffsets(all);
        while (all.stream().anyMatch(one -> consumer.position(one) < ends.get(one))) {
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                if (record.offset() < ends.get(new TopicPartition(record.topic(), record.partition()))) {
                    reader.accept(record);
                }
            }
        }
    }

    private static long epoch(ConsumerRecord<byte[], byte[]> record) {
        String text = text(record, HeaderNames.REPLAY_EPOCH);
        return text.matches("[0-9]{1,18}") ? Long.parseLong(text) : 0;
    }

    private static String scope(ConsumerRecord<byte[], byte[]> record) {
        return text(record, HeaderNames.SERVICE) + "|" + text(record, HeaderNames.SERVICE_PATH);
    }

    private static String text(ConsumerRecord<byte[], byte[]> record, String name) {
        Header header = record.headers().lastHeader(name);
        return header == null || header.value() == null ? "" : new String(header.value(), UTF_8);
    }

    @Override
    public void close() {
        consumer.close();
    }
}
