package io.furrow.control.letter;

import java.time.Duration;
import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Collection;
import java.util.Comparator;
import java.util.Deque;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.consumer.KafkaConsumer;
import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.common.errors.TimeoutException;

/** One pass backwards. A partition has a window of records that are read and not yet returned, the newest first. */
final class RecordScan {
    /** Maximum number of records that one page reads. */
    static final int MAX_READ = 20_000;

    private static final int MAX_WINDOW = 1_000;
    /** Maximum size of all windows together, where values are retained. */
    private static final int MAX_VALUES = 200;
    /** Bytes of values and headers after which a page ends. */
    private static final long MAX_CONTENT_BYTES = 4L << 20;

    private static final Duration POLL = Duration.ofMillis(200);
    private static final Comparator<Deque<Candidate>> BY_TIME =
            Comparator.comparingLong(window -> window.peek().record().time());

    /** A record that was read. Only a desired one retains its value. */
    private record Candidate(StoredRecord record, boolean isDesired) {
        static Candidate of(ConsumerRecord<byte[], byte[]> record, RecordReader.Query query) {
            boolean isDesired = query.selects(record);
            return new Candidate(StoredRecord.of(record, isDesired && query.whole()), isDesired);
        }

        int retained() {
            return record.contents() == null ? 0 : record.contents().size();
        }
    }

    private final KafkaConsumer<byte[], byte[]> consumer;
    private final Map<TopicPartition, Long> begins;
    /** The starts of the windows. */
    private final Map<TopicPartition, Long> starts;

    private final Map<TopicPartition, Deque<Candidate>> windows = new HashMap<>();
    private final RecordReader.Query query;
    private final List<StoredRecord> found = new ArrayList<>();
    private long foundBytes;
    private final long begin = System.nanoTime();

    RecordScan(
            KafkaConsumer<byte[], byte[]> consumer,
            Map<TopicPartition, Long> begins,
            Map<TopicPartition, Long> ends,
            RecordReader.Query query) {
        this.consumer = consumer;
        this.query = query;
        this.begins = begins;
        this.starts = ends;
        ends.keySet().forEach(partition -> windows.put(partition, new ArrayDeque<>()));
    }

    RecordReader.Page page() {
        int max = query.whole() ? Math.max(1, MAX_VALUES / Math.max(1, starts.size())) : MAX_WINDOW;
        int size = Math.min(max, 2 + 2 * query.limit() / Math.max(1, starts.size()));
        List<TopicPartition> unread = unread();
        for (long records = 0; !unread.isEmpty() && records < MAX_READ && !isFull() && !isLate(2); unread = unread()) {
            read(unread, size);
            records += (long) size * unread.size();
            size = Math.min(max, 2 * size);
            merge();
        }
        return new RecordReader.Page(found, next());
    }

    private boolean isFull() {
        return found.size() >= query.limit() || foundBytes >= MAX_CONTENT_BYTES;
    }

    /** Whether this part of the time for a page is over. */
    private boolean isLate(int part) {
        return System.nanoTime() - begin > Redrive.TIMEOUT.toNanos() / part;
    }

    /** Returns the partitions of which the next record is not known. */
    private List<TopicPartition> unread() {
        return starts.keySet().stream().filter(this::isUnread).toList();
    }

    private boolean isUnread(TopicPartition partition) {
        return windows.get(partition).isEmpty() && starts.get(partition) > begins.get(partition);
    }

    private void merge() {
        while (!isFull() && unread().isEmpty()) {
            Optional<Deque<Candidate>> newest = windows.values().stream()
                    .filter(window -> !window.isEmpty())
                    .max(BY_TIME);
            if (newest.isEmpty()) {
                return;
            }
            Candidate candidate = newest.get().pop();
            if (candidate.isDesired()) {
                found.add(candidate.record());
                foundBytes += candidate.retained();
            }
        }
    }

    private void read(Collection<TopicPartition> partitions, int size) {
        Map<TopicPartition, Long> ends = new HashMap<>();
        consumer.assign(partitions);
        consumer.resume(partitions);
        for (TopicPartition partition : partitions) {
            long end = starts.get(partition);
            long start = Math.max(begins.get(partition), end - size);
            ends.put(partition, end);
            starts.put(partition, start);
            consumer.seek(partition, start);
        }
        while (!ends.isEmpty()) {
            if (isLate(1)) {
                throw new TimeoutException("the records were not read within " + Redrive.TIMEOUT);
            }
            for (ConsumerRecord<byte[], byte[]> record : consumer.poll(POLL)) {
                TopicPartition partition = new TopicPartition(record.topic(), record.partition());
                if (record.offset() < ends.getOrDefault(partition, 0L)) {
                    windows.get(partition).push(Candidate.of(record, query));
                }
            }
            List<TopicPartition> done = ends.keySet().stream()
                    .filter(partition -> consumer.position(partition) >= ends.get(partition))
                    .toList();
            consumer.pause(done);
            ends.keySet().removeAll(done);
        }
    }

    /** Partitions without older records are left out. */
    private RecordPositions next() {
        Map<TopicPartition, Long> next = new HashMap<>();
        starts.forEach((partition, start) -> {
            Candidate first = windows.get(partition).peek();
            long end = first == null ? start : first.record().offset() + 1;
            if (end > begins.get(partition)) {
                next.put(partition, end);
            }
        });
        return new RecordPositions(next);
    }
}
