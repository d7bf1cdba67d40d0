package io.furrow.connect.source.journal;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.TreeMap;

import io.furrow.connect.journal.Journal;
import io.furrow.connect.journal.JournalReader;
import io.furrow.connect.journal.JournalRecord;

/**
 * Moves the records of one journal into Kafka: reads from the committed position and releases the records that are in
 * Kafka.
 */
final class JournalConsumer implements AutoCloseable {
    private final Journal journal;
    private final JournalReader reader;
    private final long start;
    private volatile long released;
    private boolean closed;
    /**
     * From and to (exclusive) of records that will never be in Kafka, because the worker was configured to skip them.
     */
    private final TreeMap<Long, Long> skipped = new TreeMap<>();

    /**
     * @param committed number of the first record that is not known to be in Kafka; empty for the oldest retained
     *     record
     */
    JournalConsumer(Journal journal, OptionalLong committed) {
        this.journal = journal;
        this.start = Math.max(committed.orElse(0), journal.begin());
        this.released = start;
        this.reader = journal.reader(start);
    }

    Journal journal() {
        return journal;
    }

    /** The position at which reading began. */
    long start() {
        return start;
    }

    /** Records that were not read yet. */
    long left() {
        return reader.left();
    }

    /** Records that were skipped because they cannot be read. */
    long lost() {
        return reader.lost();
    }

    /** The next records; empty after the consumer was closed. */
    List<JournalRecord> read(int maxRecords, long maxBytes, Duration wait) throws InterruptedException {
        synchronized (reader) {
            return closed ? List.of() : reader.read(maxRecords, maxBytes, wait);
        }
    }

    /** Marks a record that will never be in Kafka. */
    synchronized void skip(long sequence) {
        Map.Entry<Long, Long> before = skipped.floorEntry(sequence);
        if (before != null && before.getValue() > sequence) {
            return;
        }
        long from = before != null && before.getValue() == sequence ? before.getKey() : sequence;
        Long behind = skipped.remove(sequence + 1);
        skipped.put(from, behind == null ? sequence + 1 : behind);
    }

    /** Records that were not in the offset store when it was last read, without skipped ones. */
    long notReleased() {
        return journal.reader(released).left();
    }

    /**
     * Releases the records that the offset store reports in Kafka, and the skipped records directly behind them.
     * Returns whether nothing is left.
     */
    boolean release(OptionalLong committed) {
        long done = behindSkipped(Math.max(committed.orElse(0), 0));
        released = Math.max(released, done);
        journal.release(done);
        return done >= journal.end();
    }

    private synchronized long behindSkipped(long committed) {
        Map.Entry<Long, Long> around = skipped.floorEntry(committed);
        long done = around == null ? committed : Math.max(committed, around.getValue());
        skipped.headMap(committed, false).values().removeIf(to -> to < done);
        return done;
    }

    @Override
    public void close() {
        closeReader();
        journal.close();
    }

    /** Deletes the journal when none of its records are needed. */
    void delete() {
        closeReader();
        journal.delete();
    }

    /** Ends reading; the journal stays open. */
    void closeReader() {
        try {
            synchronized (reader) {
                closed = true;
                reader.close();
            }
        } catch (IOException e) {
            throw new UncheckedIOException("cannot close a file that was only read", e);
        }
    }
}
