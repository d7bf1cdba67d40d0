package io.furrow.connect.journal;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.NoSuchFileException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import io.furrow.connect.journal.SegmentFormat.End;

/** Reads durable records in order, without a cache. Not thread-safe. */
public final class JournalReader implements AutoCloseable {
    private final Segments segments;
    private final long salt;
    private final Corruptions damages;
    private final GroupCommit commit;
    private volatile long position;
    private volatile long lost;
    private Segment segment;
    private RecordCursor cursor;

    JournalReader(Segments segments, long salt, Corruptions damages, GroupCommit commit, long from) {
        this.segments = segments;
        this.salt = salt;
        this.damages = damages;
        this.commit = commit;
        this.position = from;
    }

    /** The lowest sequence number that the next record can have. */
    public long position() {
        return position;
    }

    /**
     * The number of records that were skipped because they cannot be read, without those missing before the first read.
     */
    public long lost() {
        return lost;
    }

    /** The number of records from the position to the end, readable or not. */
    public long left() {
        return segments.recordsFrom(position);
    }

    /**
     * The next records.
     *
     * @param maxBytes of payload; a larger record comes alone
     * @param wait at most, for the first; not at all for more
     * @throws UncheckedIOException if a file cannot be read
     */
    public List<JournalRecord> read(int maxRecords, long maxBytes, Duration wait) throws InterruptedException {
        long deadline = System.nanoTime() + wait.toNanos();
        List<JournalRecord> records = new ArrayList<>();
        long bytes = 0;
        while (records.size() < maxRecords && bytes < maxBytes) {
            JournalRecord record = next();
            if (record != null) {
                records.add(record);
                bytes += record.payload().length;
            } else if (!records.isEmpty() || !awaitMore(deadline)) {
                break;
            }
        }
        return records;
    }

    private boolean awaitMore(long deadline) throws InterruptedException {
        return commit.awaitGroup(this::hasMore, deadline);
    }

    private boolean hasMore() {
        Segment last = segments.last();
        return last != null && last.end().sequence() > position;
    }

    private JournalRecord next() {
        try {
            while (segment != null || advance()) {
                // In this order: a sealed segment has its last end.
                boolean sealed = segment.sealed();
                End end = segment.end();
                JournalRecord record = cursor.next(end);
                if (record == null) {
                    passOverTo(cursor.at().sequence());
                    if (!sealed || !advance()) {
                        return null;
                    }
                } else if (record.sequence() >= position) {
                    passOverTo(record.sequence());
                    position = record.sequence() + 1;
                    return record;
                }
            }
            return null;
        } catch (IOException e) {
            throw new UncheckedIOException("cannot read " + segment.file(), e);
        }
    }

    private void passOverTo(long sequence) {
        if (sequence > position) {
            lost += sequence - position;
            position = sequence;
        }
    }

    /** Goes to the next segment if there is one. */
    private boolean advance() throws IOException {
        Segment next = segments.holding(
                segment == null ? position : Math.max(position, segment.end().sequence()));
        if (next == segment && segment != null) {
            next = segments.after(segment);
        }
        if (next == null) {
            return false;
        }
        close();
        segment = next;
        position = Math.max(position, next.base());
        try {
            cursor = new RecordCursor(next.file(), next.base(), salt, damages::note);
        } catch (NoSuchFileException e) {
            End end = next.end();
            long missing = end.sequence() - next.base();
            damages.note(new Corruption(
                    next.base(), SegmentFormat.HEADER, end.position(), next.base(), missing, Corruption.Kind.MISSING));
            passOverTo(end.sequence());
            boolean more = segments.after(next) != null && advance();
            segment = more ? segment : null;
            return more;
        }
        return true;
    }

    @Override
    public void close() throws IOException {
        if (cursor != null) {
            cursor.close();
            cursor = null;
        }
        segment = null;
    }
}
