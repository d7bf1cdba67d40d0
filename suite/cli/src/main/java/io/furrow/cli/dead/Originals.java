package io.furrow.cli.dead;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.Arrays;
import java.util.List;
import java.util.Optional;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.PartitionInfo;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.header.Header;

import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.OriginalReference;

/** Reads the records that dead letters stand for, from where these say they are. */
final class Originals implements AutoCloseable {
    private final KafkaConsumer<byte[], byte[]> consumer;

    /** @param consumer is closed with this */
    Originals(KafkaConsumer<byte[], byte[]> consumer) {
        this.consumer = consumer;
    }

    /**
     * Empty if the record is no longer there, or another is in its place, because the topic was made again: letter and original
     * have one time and one key.
     *
     * @throws IOException if Kafka does not answer
     */
    Optional<ConsumerRecord<byte[], byte[]>> find(
            OriginalReference originalReference, ConsumerRecord<byte[], byte[]> letter) throws IOException {
        TopicPartition partition = new TopicPartition(originalReference.topic(), originalReference.partition());
        List<PartitionInfo> known = consumer.partitionsFor(originalReference.topic(), Redrive.TIMEOUT);
        if (known == null || known.stream().noneMatch(info -> info.partition() == originalReference.partition())) {
            return Optional.empty();
        }
        consumer.assign(List.of(partition));
        long first =
                consumer.beginningOffsets(List.of(partition), Redrive.TIMEOUT).get(partition);
        long end = consumer.endOffsets(List.of(partition), Redrive.TIMEOUT).get(partition);
        if (originalReference.offset() < first || originalReference.offset() >= end) {
            return Optional.empty();
        }
        consumer.seek(partition, originalReference.offset());
        return read(partition, originalReference.offset()).filter(found -> isOf(letter, found));
    }

    private Optional<ConsumerRecord<byte[], byte[]>> read(TopicPartition partition, long offset) throws IOException {
        long until = System.nanoTime() + Redrive.TIMEOUT.toNanos();
        while (consumer.position(partition) <= offset) {
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(Duration.ofMillis(200))) {
                if (record.offset() == offset) {
                    return Optional.of(record);
                }
            }
            if (System.nanoTime() > until) {
                throw new IOException("%s-%d@%d cannot be read; does its broker answer?"
                        .formatted(partition.topic(), partition.partition(), offset));
            }
        }
        return Optional.empty();
    }

    /** That of the original: what is set aside as from the future has a time of its own. */
    static long timeOf(ConsumerRecord<byte[], byte[]> letter) {
        Header time = letter.headers().lastHeader(DeadLetter.TIME);
        try {
            return time == null ? letter.timestamp() : Long.parseLong(new String(time.value(), StandardCharsets.UTF_8));
        } catch (NumberFormatException e) { // somebody else's
            return letter.timestamp();
        }
    }

    private static boolean isOf(ConsumerRecord<byte[], byte[]> letter, ConsumerRecord<byte[], byte[]> found) {
        boolean sameKey = letter.key() == null || Arrays.equals(letter.key(), found.key());
        return sameKey && timeOf(letter) == found.timestamp();
    }

    @Override
    public void close() {
        consumer.close();
    }
}
