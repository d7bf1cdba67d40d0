package io.furrow.mission.topic;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.TimeoutException;
import org.apache.kafka.common.header.Header;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.file.ArchiveLine;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;

/** Reads the records of a topic from its beginning to its current end and passes the events to a sorter. */
final class EventTopicReader {
    private static final Duration POLL = Duration.ofMillis(500);

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final List<TopicPartition> partitions;
    private final long endTime;
    private final EventSorter sorter;
    private long skipped;
    private String example;

    /**
     * @param consumer reads committed records; this class assigns it
     * @param partitions all partitions of the topic
     * @param endTime event time, epoch ms, exclusive
     */
    EventTopicReader(
            KafkaConsumer<byte[], byte[]> consumer, List<TopicPartition> partitions, long endTime, EventSorter sorter) {
        this.consumer = consumer;
        this.partitions = partitions;
        this.endTime = endTime;
        this.sorter = sorter;
    }

    /** Returns the number of records that are not events. */
    long skipped() {
        return skipped;
    }

    /** Returns the first record that is not an event, and why; null if there is none. */
    String example() {
        return example;
    }

    /** @param timeout after which a silent broker counts as unavailable */
    void read(Duration timeout) throws IOException {
        consumer.assign(partitions);
        consumer.seekToBeginning(partitions);
        Map<TopicPartition, Long> ends = consumer.endOffsets(partitions);
        Map<TopicPartition, Long> positions = new HashMap<>();
        Set<TopicPartition> open = new HashSet<>(partitions);
        long progressed = System.nanoTime();
        while (!open.isEmpty()) {
            RecordingInterruptedException.check();
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                if (record.offset() < ends.get(new TopicPartition(record.topic(), record.partition()))) {
                    sort(record);
                }
            }
            for (TopicPartition partition : List.copyOf(open)) {
                long position = consumer.position(partition);
                if (!Long.valueOf(position).equals(positions.put(partition, position))) {
                    progressed = System.nanoTime();
                }
                if (position >= ends.get(partition)) {
                    open.remove(partition);
                    consumer.pause(List.of(partition));
                }
            }
            if (System.nanoTime() - progressed > timeout.toNanos()) {
                throw new TimeoutException("no record came for " + timeout.toMillis() + " ms");
            }
        }
    }

    private void sort(ConsumerRecord<byte[], byte[]> record) throws IOException {
        try {
            StoredEvent event = event(record);
            if (event.time() < endTime) {
                sorter.add(new SortedEvent(
                        Cursor.after(event), record.partition(), record.offset(), ArchiveLine.write(event)));
            }
        } catch (UnreadableException e) {
            skipped++;
            example = example == null
                    ? "partition %d, offset %d: %s".formatted(record.partition(), record.offset(), e.getMessage())
                    : example;
        }
    }

    private static StoredEvent event(ConsumerRecord<byte[], byte[]> record) throws UnreadableException {
        Reason.NOT_AN_EVENT.refuseIf(record.timestamp() < 0, "the record has no timestamp");
        Map<String, String> headers = new TreeMap<>();
        for (Header header : record.headers()) {
            if (header.value() != null) {
                headers.put(header.key(), new String(header.value(), StandardCharsets.UTF_8));
            }
        }
        String eventId = headers.get(HeaderNames.CE_ID);
        String id = eventId == null || eventId.isEmpty()
                ? record.topic() + "-" + record.partition() + "-" + record.offset()
                : eventId;
        Entity entity = record.value() == null ? null : Entity.parse(record.value());
        return new StoredEvent(
                id,
                record.timestamp(),
                entity == null ? key(record) : entity.id(),
                EventDocumentCodec.storedHeaders(headers),
                entity == null ? null : entity.json());
    }

    private static String key(ConsumerRecord<byte[], byte[]> record) throws UnreadableException {
        Reason.NOT_AN_EVENT.refuseIf(record.key() == null, "the deletion names no entity: the record has no key");
        return new String(record.key(), StandardCharsets.UTF_8);
    }
}
