package io.furrow.connect.journal;

import java.nio.file.Path;

import io.furrow.connect.journal.SegmentFormat.End;

/** A segment file of the journal: one that is being written, or one that does not grow any more. */
final class Segment {
    private final long base;
    private final Path file;
    private final long capacity;
    private volatile End end;
    private volatile boolean sealed;

    private Segment(long base, Path file, long capacity, End end, boolean sealed) {
        this.base = base;
        this.file = file;
        this.capacity = capacity;
        this.end = end;
        this.sealed = sealed;
    }

    /** A new segment for writing. */
    static Segment created(long base, Path file, long capacity) {
        return new Segment(base, file, capacity, new End(SegmentFormat.HEADER, base), false);
    }

    /** An existing segment, with the end of its durable records. */
    static Segment found(long base, Path file, long length, End end) {
        return new Segment(base, file, length, end, true);
    }

    long base() {
        return base;
    }

    Path file() {
        return file;
    }

    /** Size on the disk. */
    long capacity() {
        return capacity;
    }

    /** The end of its durable records; read {@link #sealed} before this if both are needed. */
    End end() {
        return end;
    }

    boolean sealed() {
        return sealed;
    }

    void durableTo(End now) {
        end = now;
    }

    void seal() {
        sealed = true;
    }
}
