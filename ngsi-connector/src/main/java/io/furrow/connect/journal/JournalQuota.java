package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;

/** Decides whether more records may be appended. It errs on the low side: files may end before they are full. */
record JournalQuota(JournalSettings settings, Path folder, Disk disk, Segments segments) {

    /**
     * Whether records fit in addition to those that wait to be written.
     *
     * @param waiting bytes of the waiting ones
     */
    boolean isFor(long bytes, long waiting) {
        if (waiting > 0 && waiting + bytes > settings.maxWaiting()) {
            return false;
        }
        long toWrite = waiting + bytes;
        if (toWrite <= leftInLast()) {
            return true;
        }
        long needed = settings.needed(toWrite);
        return segments.bytes() + needed <= settings.maxBytes() && isFree(needed);
    }

    /** Whether one more segment of the usual size fits, full or empty. */
    boolean isForSegment() {
        long needed = settings.segmentBytes();
        return segments.bytes() + needed <= settings.maxBytes() && isFree(needed);
    }

    boolean isHalfFull() {
        return segments.bytes() > settings.maxBytes() / 2;
    }

    /** Size of records on the disk. */
    static long sizeOf(List<byte[]> payloads) {
        return payloads.stream().mapToLong(SegmentFormat::sizeOf).sum();
    }

    /** Whether the disk has this many bytes besides those that must stay free. */
    boolean isFree(long bytes) {
        try {
            return disk.usable(folder) - bytes >= settings.minFree();
        } catch (IOException e) {
            // The writer will meet the same error and report it.
            return true;
        }
    }

    private long leftInLast() {
        Segment last = segments.last();
        return last == null || last.sealed() ? 0 : last.capacity() - last.end().position();
    }
}
