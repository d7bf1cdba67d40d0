package io.furrow.cli.compare;

import java.time.Duration;
import java.util.Collection;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
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
import io.furrow.model.text.FailureText;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Reads topics from Kafka itself. */
final class KafkaTopics implements ResultTopics {
    private static final Duration POLL = Duration.ofMillis(200);
    private static final Duration TIMEOUT = Duration.ofSeconds(20);
    /** Several, because the last offsets of a partition may be a transaction's markers. */
    private static final int LAST_RECORDS = 50;

    private final KafkaConsumer<byte[], byte[]> consumer;
    /** By topic. */
    private final Map<String, Integer> partitions = new HashMap<>();

    /** @param client settings of Kafka clients, with {@code bootstrap.servers} */
    KafkaTopics(Properties client) {
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

    @Override
    public Collection<String> names() {
        return Set.copyOf(partitions.keySet());
    }

    @Override
    public void read(String topic, long from, Consumer<ResultRecord> reader) {
        List<TopicPartition> all = assign(topic);
        consumer.seekToBeginning(all);
        toEnd(all, reader);
    }

    @Override
    public void readNewest(String topic, Consumer<ResultRecord> reader) {
        List<TopicPartition> all = assign(topic);
        Map<TopicPartition, Long> begins = consumer.beginningOffsets(all);
        consumer.endOffsets(all)
                .forEach((one, end) -> consumer.seek(one, Math.max(begins.get(one), end - LAST_RECORDS)));
        toEnd(all, reader);
    }

    private List<TopicPartition> assign(String topic) {
        List<TopicPartition> all = IntStream.range(0, partitions.get(topic))
                .mapToObj(number -> new TopicPartition(topic, number))
                .toList();
        consumer.assign(all);
        return all;
    }

    private void toEnd(List<TopicPartition> all, Consumer<ResultRecord> reader) {
        Map<TopicPartition, Long> ends = consumer.endOffsets(all);
        while (all.stream().anyMatch(one -> consumer.position(one) < ends.get(one))) {
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                if (record.offset() < ends.get(new TopicPartition(record.topic(), record.partition()))) {
                    reader.accept(record(record));
                }
            }
        }
    }

    private static ResultRecord record(ConsumerRecord<byte[], byte[]> record) {
        Map<String, String> headers = new HashMap<>();
        for (Header header : record.headers()) {
            headers.put(header.key(), header.value() == null ? "" : new String(header.value(), UTF_8));
        }
        String place = "%s-%d@%d".formatted(record.topic(), record.partition(), record.offset());
        return new ResultRecord(place, headers, record.value());
    }

    @Override
    public void close() {
        consumer.close();
    }
}
