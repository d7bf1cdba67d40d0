package io.furrow.connect.journal;

import java.io.Closeable;
import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.channels.FileChannel;
import java.nio.file.Path;
import java.nio.file.StandardOpenOption;
import java.util.function.Consumer;

import io.furrow.connect.journal.Corruption.Kind;
import io.furrow.connect.journal.SegmentFormat.End;

/**
 * Reads the records of one segment file in order, up to an end that may move. Invalid bytes are skipped up to the next
 * record, and reported.
 */
final class RecordCursor implements Closeable {
    private static final int WINDOW = 256 * 1024;

    private final long base;
    private final long salt;
    private final FileChannel channel;
    private final Consumer<Corruption> damages;
    private ByteBuffer window = ByteBuffer.allocate(WINDOW).limit(0);
    private long windowAt;
    private long position = SegmentFormat.HEADER;
    private long sequence;

    RecordCursor(Path file, long base, long salt, Consumer<Corruption> damages) throws IOException {
        this.base = base;
        this.salt = salt;
        this.sequence = base;
        this.damages = damages;
        this.channel = FileChannel.open(file, StandardOpenOption.READ);
    }

    /** The position after the last record read. */
    End at() {
        return new End(position, sequence);
    }

    /** The next record before {@code end}, or null. */
    JournalRecord next(End end) throws IOException {
        if (position >= end.position()) {
            return null;
        }
        long limit = Math.min(end.position(), channel.size());
        JournalRecord record = recordAt(position, limit, Long.MAX_VALUE);
        if (record != null) {
            return passed(record);
        }
        long found = firstRecordBehind(position, limit);
        if (found < 0) {
            Kind kind = limit < end.position() ? Kind.TRUNCATED : Kind.CORRUPT;
            damages.accept(new Corruption(base, position, end.position(), sequence, end.sequence() - sequence, kind));
            position = end.position();
            sequence = end.sequence();
            return null;
        }
        record = recordAt(found, limit, Long.MAX_VALUE);
        damages.accept(new Corruption(base, position, found, sequence, record.sequence() - sequence, Kind.CORRUPT));
        skippedTo(found, record);
        return passed(record);
    }

    /** Reads to the last complete record if the end is unknown; the bytes after it are reported. */
    End readToUnknownEnd() throws IOException {
        long limit = channel.size();
        while (true) {
            JournalRecord record = recordAt(position, limit, Long.MAX_VALUE);
            if (record == null && onlyZerosFrom(position, limit)) {
                return at();
            }
            if (record == null) {
                long found = firstRecordBehind(position, limit);
                if (found < 0) {
                    damages.accept(new Corruption(base, position, limit, sequence, Corruption.UNKNOWN, Kind.TORN_TAIL));
                    return at();
                }
                record = recordAt(found, limit, Long.MAX_VALUE);
                damages.accept(
                        new Corruption(base, position, found, sequence, record.sequence() - sequence, Kind.CORRUPT));
                skippedTo(found, record);
            }
            passed(record);
        }
    }

    private void skippedTo(long found, JournalRecord record) {
        position = found;
        sequence = record.sequence();
    }

    private JournalRecord passed(JournalRecord record) {
        if (record.sequence() > sequence) {
            long missing = record.sequence() - sequence;
            damages.accept(new Corruption(base, position, position, sequence, missing, Kind.MISSING));
        }
        position += SegmentFormat.sizeOf(record.payload());
        sequence = record.sequence() + 1;
        return record;
    }

    /** The position of the next record after an invalid position, or -1. */
    private long firstRecordBehind(long broken, long limit) throws IOException {
        for (long at = broken + 1; at + SegmentFormat.RECORD_HEADER < limit; at++) {
            // A record has at least one byte of payload, which limits the number of records in a hole.
            long mostMissing = (at - broken) / (SegmentFormat.RECORD_HEADER + 1) + 1;
            if (recordAt(at, limit, sequence + mostMissing) != null) {
                return at;
            }
        }
        return -1;
    }

    /** The record that begins at a position, or null if there is none, or its number exceeds {@code highest}. */
    private JournalRecord recordAt(long at, long limit, long highest) throws IOException {
        if (limit - at <= SegmentFormat.RECORD_HEADER) {
            return null;
        }
        load(at, SegmentFormat.RECORD_HEADER, limit);
        int offset = (int) (at - windowAt);
        int length = window.getInt(offset);
        long number = window.getLong(offset + 4);
        boolean plausible = length > 0 && length <= limit - at - SegmentFormat.RECORD_HEADER;
        if (!plausible || number < sequence || number > highest) {
            return null;
        }
        int checksum = window.getInt(offset + 12);
        load(at, SegmentFormat.RECORD_HEADER + length, limit);
        offset = (int) (at - windowAt) + SegmentFormat.RECORD_HEADER;
        if (SegmentFormat.checksum(salt, number, window.slice(offset, length)) != checksum) {
            return null;
        }
        byte[] payload = new byte[length];
        window.get(offset, payload);
        return new JournalRecord(number, payload);
    }

    private boolean onlyZerosFrom(long from, long limit) throws IOException {
        for (long at = from; at < limit; at++) {
            load(at, 1, limit);
            if (window.get((int) (at - windowAt)) != 0) {
                return false;
            }
        }
        return true;
    }

    /** Loads bytes of the file into the window, but none after the limit: they may still change. */
    private void load(long at, int length, long limit) throws IOException {
        if (at >= windowAt && at + length <= windowAt + window.limit()) {
            return;
        }
        if (length > window.capacity() || (length <= WINDOW && window.capacity() > WINDOW)) {
            window = ByteBuffer.allocate(Math.max(WINDOW, length));
        }
        window.clear().limit((int) Math.min(window.capacity(), limit - at));
        windowAt = at;
        while (window.position() < length) {
            int read = channel.read(window, at + window.position());
            if (read < 0) {
                throw new IOException("the file became shorter while it was read");
            }
        }
        window.flip();
    }

    @Override
    public void close() throws IOException {
        channel.close();
    }
}
