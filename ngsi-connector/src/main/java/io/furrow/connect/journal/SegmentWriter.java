package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.ByteBuffer;
import java.nio.file.Path;
import java.util.List;

import io.furrow.connect.journal.SegmentFormat.End;
import io.furrow.connect.journal.SegmentFormat.Header;

/**
 * Writes records into segment files and continues in the next file when one is full. After an error it never uses the
 * same file again: after a failed sync it is unknown which bytes are on disk, and a second sync may succeed without
 * having written anything. Such a file ends at the previous durable position. Not thread-safe.
 */
final class SegmentWriter {
    private static final int BUFFER = 1024 * 1024;
    private static final int FIRST_SEGMENT = 4 * 1024 * 1024;

    private final Path folder;
    private final long salt;
    private final int segmentBytes;
    private final Disk disk;
    private final Segments segments;
    private final ByteBuffer recordHeader = ByteBuffer.allocate(SegmentFormat.RECORD_HEADER);
    private final ByteBuffer buffer = ByteBuffer.allocateDirect(BUFFER);
    private Disk.SegmentFile file;
    private Segment segment;
    private long written;
    private long sequence;
    private long durable;
    private boolean first = true;
    private boolean nextPrepared = true;

    SegmentWriter(Path folder, int segmentBytes, Disk disk, Segments segments) {
        this.folder = folder;
        this.salt = SegmentFormat.saltOf(folder.getFileName().toString());
        this.segmentBytes = segmentBytes;
        this.disk = disk;
        this.segments = segments;
        this.sequence = segments.last() == null ? 0 : segments.last().end().sequence();
        this.durable = sequence;
    }

    /** The number of the next record. */
    long sequence() {
        return sequence;
    }

    /** Raises the number of the next record; only before the first. */
    void skipTo(long number) {
        if (segment != null || number < sequence) {
            throw new IllegalStateException("cannot go from " + sequence + " to " + number);
        }
        sequence = number;
    }

    /** The number after the last record that a {@link #sync} made durable, or that existed at the opening. */
    long durable() {
        return durable;
    }

    /**
     * Writes the records of one append, without a sync to the disk before {@link #sync}. One file holds them all, and earlier
     * records are made durable before a new file is created: an error leaves no append that is partly durable.
     *
     * @param bytes that the records take in a file
     */
    void write(List<byte[]> payloads, long bytes) throws IOException {
        if (segment == null || written + buffer.position() + bytes > segment.capacity()) {
            roll(bytes);
        }
        for (byte[] payload : payloads) {
            SegmentFormat.writeRecordHeader(recordHeader, salt, sequence, payload);
            put(recordHeader);
            put(ByteBuffer.wrap(payload));
            sequence++;
        }
    }

    private void put(ByteBuffer bytes) throws IOException {
        while (bytes.hasRemaining()) {
            if (!buffer.hasRemaining()) {
                drain();
            }
            int part = Math.min(bytes.remaining(), buffer.remaining());
            buffer.put(bytes.slice(bytes.position(), part));
            bytes.position(bytes.position() + part);
        }
    }

    private void drain() throws IOException {
        buffer.flip();
        int length = buffer.remaining();
        file.write(buffer, written);
        written += length;
        buffer.clear();
    }

    /** Makes the written records durable, and visible to readers. */
    void sync() throws IOException {
        if (segment == null || segment.end().sequence() == sequence) {
            return;
        }
        drain();
        file.sync();
        segment.durableTo(new End(written, sequence));
        durable = sequence;
    }

    private void roll(long bytes) throws IOException {
        sync();
        leaveSegment();
        int usual = first ? Math.min(segmentBytes, FIRST_SEGMENT) : segmentBytes;
        long capacity = Math.max(usual, SegmentFormat.HEADER + bytes);
        // A file without records is replaced by the new one, which then has the same number.
        Segment before = segments.lastBefore(sequence);
        Header header = before == null
                ? new Header(sequence, capacity, Header.NONE, new End(0, sequence))
                : new Header(sequence, capacity, before.base(), before.end());
        Path path = folder.resolve(SegmentFormat.fileName(sequence));
        file = disk.create(path, SegmentFormat.write(header, salt), capacity);
        segment = Segment.created(sequence, path, capacity);
        segments.add(segment);
        written = SegmentFormat.HEADER;
        first = false;
        nextPrepared = false;
    }

    /** Whether {@link #prepareNext} has something to do. */
    boolean isNextUnprepared() {
        return !nextPrepared;
    }

    /** Preallocates the file after this one, if there is room for it. */
    void prepareNext(boolean room) {
        nextPrepared = true;
        if (room) {
            disk.prepare(folder, segmentBytes);
        }
    }

    /** Abandons the file after an error: it ends at its last durable record. */
    void abandon() {
        buffer.clear();
        if (segment != null) {
            // No later file may have the name of this one.
            sequence = Math.max(sequence, segment.base() + 1);
        }
        leaveSegment();
    }

    private void leaveSegment() {
        if (segment == null) {
            return;
        }
        segment.seal();
        segment = null;
        try {
            file.close();
        } catch (IOException e) {
            // The durable part was synced, or the file was already abandoned.
            file = null;
        }
    }

    void close() {
        leaveSegment();
        disk.close();
    }
}
