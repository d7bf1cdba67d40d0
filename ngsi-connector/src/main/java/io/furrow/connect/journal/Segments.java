package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentSkipListMap;
import java.util.concurrent.atomic.AtomicLong;

/** The segment files of an open journal, by their first sequence number. */
final class Segments {
    private final ConcurrentSkipListMap<Long, Segment> byBase = new ConcurrentSkipListMap<>();
    private final AtomicLong bytes = new AtomicLong();

    Segments(List<Segment> found) {
        found.forEach(this::add);
    }

    void add(Segment segment) {
        Segment replaced = byBase.put(segment.base(), segment);
        bytes.addAndGet(segment.capacity() - (replaced == null ? 0 : replaced.capacity()));
    }

    /** Bytes on the disk. */
    long bytes() {
        return bytes.get();
    }

    Segment last() {
        Map.Entry<Long, Segment> last = byBase.lastEntry();
        return last == null ? null : last.getValue();
    }

    /** The last segment that begins below a number, or null. */
    Segment lastBefore(long sequence) {
        Map.Entry<Long, Segment> before = byBase.lowerEntry(sequence);
        return before == null ? null : before.getValue();
    }

    Segment first() {
        Map.Entry<Long, Segment> first = byBase.firstEntry();
        return first == null ? null : first.getValue();
    }

    /** The segment that contains a sequence number, else the first, or null. */
    Segment holding(long sequence) {
        Map.Entry<Long, Segment> floor = byBase.floorEntry(sequence);
        return floor == null ? first() : floor.getValue();
    }

    Segment after(Segment segment) {
        Map.Entry<Long, Segment> next = byBase.higherEntry(segment.base());
        return next == null ? null : next.getValue();
    }

    /** The number of records from a sequence number on, without numbers skipped between files. */
    long recordsFrom(long sequence) {
        long records = 0;
        for (Segment segment : byBase.values()) {
            records += Math.max(0, segment.end().sequence() - Math.max(sequence, segment.base()));
        }
        return records;
    }

    /** Deletes files with numbers below one only; the last stays, because it determines the next number. */
    void release(long below) throws IOException {
        for (Segment segment : byBase.values()) {
            if (!segment.sealed() || segment.end().sequence() > below || segment == last()) {
                return;
            }
            Files.deleteIfExists(segment.file());
            byBase.remove(segment.base());
            bytes.addAndGet(-segment.capacity());
        }
    }
}
