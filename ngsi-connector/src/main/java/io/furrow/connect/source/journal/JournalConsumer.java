package io.furrow.connect.source.journal;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.ArrayDeque;
import java.util.Deque;
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
    private static final long NOTHING = -1;

    private final Journal journal;
    private final JournalReader reader;
    private final long start;
    private final Duration retention;
    private final Deque<Done> done = new ArrayDeque<>();
    private volatile long released;
    private volatile long outdated;
    private boolean closed;
    /**
     * From and to (exclusive) of records that need no offset: those that will never be in Kafka, and those that are there
     * again although the committed position is still an outdated one.
     */
    private final TreeMap<Long, Long> skipped = new TreeMap<>();

    /**
     * @param committed number of the first record that is not confirmed in Kafka; empty for the oldest retained record
     * @param retention how long records stay after they were committed
     */
    JournalConsumer(Journal journal, OptionalLong committed, Duration retention) {
        this(journal, Math.max(committed.orElse(0), journal.begin()), NOTHING, retention);
    }

    /**
     * Begins at a record before the committed position, because Kafka lost it.
     *
     * @param outdated the committed position, to be ignored until another one is committed or Kafka has all records before
     *     it again
     */
    JournalConsumer(Journal journal, long start, long outdated, Duration retention) {
        this.journal = journal;
        this.start = start;
        this.released = start;
        this.outdated = outdated;
        this.retention = retention;
        this.reader = journal.reader(start);
    }

    Journal journal() {
        return journal;
    }

    /** The position at which reading began. */
    long start() {
        return start;
    }

    /** Number of records not read yet. */
    long left() {
        return reader.left();
    }

    /** Number of records skipped because they cannot be read. */
    long lost() {
        return reader.lost();
    }

    /** The next records; empty after the consumer was closed. */
    List<JournalRecord> read(int maxRecords, long maxBytes, Duration wait) throws InterruptedException {
        synchronized (reader) {
            if (closed) {
                return List.of();
            }
            long next = reader.position();
            List<JournalRecord> records = reader.read(maxRecords, maxBytes, wait);
            if (next < outdated) {
                skipMissing(next, records);
            }
            return records;
        }
    }

    /** Numbers without a readable record. */
    private void skipMissing(long from, List<JournalRecord> records) {
        long next = from;
        for (JournalRecord record : records) {
            skip(next, record.sequence());
            next = record.sequence() + 1;
        }
        skip(next, reader.position());
    }

    /** Kafka has acknowledged a record of some journal. */
    void acknowledged(String ofJournal, long sequence) {
        if (sequence < outdated && journal.id().equals(ofJournal)) {
            skip(sequence);
        }
    }

    /** Marks a record that will never be in Kafka. */
    void skip(long sequence) {
        skip(sequence, sequence + 1);
    }

    private synchronized void skip(long first, long end) {
        Map.Entry<Long, Long> before = skipped.floorEntry(first);
        if (first >= end || before != null && before.getValue() >= end) {
            return;
        }
        long from = before != null && before.getValue() >= first ? before.getKey() : first;
        Long behind = skipped.remove(end);
        skipped.put(from, behind == null ? end : behind);
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
        long known = committed.orElse(0);
        if (known == outdated && behindSkipped(start) < Math.min(outdated, journal.end())) {
            return false;
        }
        outdated = NOTHING;
        long upTo = behindSkipped(Math.max(known, 0));
        released = Math.max(released, upTo);
        long free = retained(upTo);
        journal.release(free);
        return free >= journal.end();
    }

    /** The position that was reached before the retention, or the current one if the journal is short of space. */
    private long retained(long upTo) {
        long now = System.nanoTime();
        done.add(new Done(now, upTo));
        long free = 0;
        while (!done.isEmpty() && (journal.isHalfFull() || now - done.peek().nanos() >= retention.toNanos())) {
            free = Math.max(free, done.remove().upTo());
        }
        return free;
    }

    /** The time at which everything below a position was in Kafka. */
    private record Done(long nanos, long upTo) {}

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
