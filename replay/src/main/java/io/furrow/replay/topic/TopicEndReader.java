package io.furrow.replay.topic;

import java.io.IOException;
import java.io.Serializable;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import org.apache.kafka.clients.consumer.ConsumerConfig;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.KafkaException;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.InterruptException;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;

import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.text.FailureText;

/**
 * Reads the greatest epoch and timestamp at the end of a replay's topic, including records of uncommitted transactions.
 * The topic may have records that are newer than the checkpoint; the number of an epoch must not be used twice, and
 * timestamps must not step back.
 *
 * @param client settings of Kafka clients, including {@code bootstrap.servers}
 */
record TopicEndReader(Properties client) implements Serializable {
    private static final Duration POLL = Duration.ofMillis(200);
    /** The last offsets of a partition may be those of transaction markers, which are not records. */
    private static final long TAIL_OFFSETS = 100;

    /** @throws IOException if Kafka is unavailable */
    TopicEnd of(String topic) throws IOException, InterruptedException {
        Properties settings = CommittedReader.boundedSettings(client);
        settings.setProperty(ConsumerConfig.ISOLATION_LEVEL_CONFIG, "read_uncommitted");
        try (KafkaConsumer<byte[], byte[]> consumer =
                new KafkaConsumer<>(settings, new ByteArrayDeserializer(), new ByteArrayDeserializer())) {
            List<TopicPartition> partitions = consumer.partitionsFor(topic).stream()
                    .map(info -> new TopicPartition(topic, info.partition()))
                    .toList();
            consumer.assign(partitions);
            TopicEnd newest = TopicEnd.EMPTY;
            Map<TopicPartition, Long> begins = consumer.beginningOffsets(partitions);
            Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
            for (TopicPartition partition : partitions) {
                consumer.assign(List.of(partition));
                consumer.seek(partition, Math.max(begins.get(partition), ends.get(partition) - TAIL_OFFSETS));
                while (consumer.position(partition) < ends.get(partition)) {
                    for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                        newest = newest.with(epoch(record), record.timestamp());
                    }
                }
            }
            return newest;
        } catch (InterruptException e) {
            Thread.interrupted(); // Kafka sets it again
            InterruptedException interrupted =
                    new InterruptedException("interrupted while the end of a topic was read");
            interrupted.initCause(e);
            throw interrupted;
        } catch (KafkaException e) {
            throw new IOException("The end of topic " + topic + " cannot be read: " + FailureText.of(e), e);
        }
    }

    private static long epoch(ConsumerRecord<byte[], byte[]> record) {
        String epoch = KafkaClients.text(record.headers(), HeaderNames.REPLAY_EPOCH);
        try {
            return epoch == null ? TopicEnd.EMPTY.epoch() : Long.parseLong(epoch);
        } catch (NumberFormatException e) { // not written by a replay
            return TopicEnd.EMPTY.epoch();
        }
    }
}
