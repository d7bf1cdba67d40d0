package io.furrow.control.letter;

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

/** Reads the original records that dead letters refer to. */
final class OriginalReader implements AutoCloseable {
    private final KafkaConsumer<byte[], byte[]> consumer;

    /** @param consumer closed with this reader */
    OriginalReader(KafkaConsumer<byte[], byte[]> consumer) {
        this.consumer = consumer;
    }

    /**
     * Empty if the record is gone, or another is in its place because the topic was recreated: letter and original have the
     * same time and key.
     *
     * @throws IOException if Kafka does not answer
     */
    Optional<ConsumerRecord<byte[], byte[]>> find(OriginalReference original, ConsumerRecord<byte[], byte[]> deadLetter)
            throws IOException {
        TopicPartition partition = new TopicPartition(original.topic(), original.partition());
        return find(partition, original.offset()).filter(found -> isOf(deadLetter, found));
    }

    /**
     * Returns the record at an offset; empty if there is none.
     *
     * @throws IOException if Kafka does not answer
     */
    Optional<ConsumerRecord<byte[], byte[]>> find(TopicPartition partition, long offset) throws IOException {
        List<PartitionInfo> existing = consumer.partitionsFor(partition.topic(), Redrive.TIMEOUT);
        if (existing == null || existing.stream().noneMatch(info -> info.partition() == partition.partition())) {
            return Optional.empty();
        }
        consumer.assign(List.of(partition));
        long first =
                consumer.beginningOffsets(List.of(partition), Redrive.TIMEOUT).get(partition);
        long end = consumer.endOffsets(List.of(partition), Redrive.TIMEOUT).get(partition);
        if (offset < first || offset >= end) {
            return Optional.empty();
        }
        consumer.seek(partition, offset);
        return read(partition, offset);
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

    /** The time of the original: a letter about a record from the future has its own time. */
    static long timeOf(ConsumerRecord<byte[], byte[]> deadLetter) {
        Header time = deadLetter.headers().lastHeader(DeadLetter.TIME);
        try {
            return time == null
                    ? deadLetter.timestamp()
                    : Long.parseLong(new String(time.value(), StandardCharsets.UTF_8));
        } catch (NumberFormatException e) { // another producer's header
            return deadLetter.timestamp();
        }
    }

    private static boolean isOf(ConsumerRecord<byte[], byte[]> deadLetter, ConsumerRecord<byte[], byte[]> found) {
        boolean sameKey = deadLetter.key() == null || Arrays.equals(deadLetter.key(), found.key());
        return sameKey && timeOf(deadLetter) == found.timestamp();
    }

    @Override
    public void close() {
        consumer.close();
    }
}
