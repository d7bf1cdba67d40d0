package io.furrow.connect.journal;

import java.io.IOException;
import java.nio.file.Files;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ConcurrentSkipListMap;
import java.util.concurrent.atomic.AtomicLong;

/** The segment files of an open journal, by the sequence number that each begins with. */
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

    /** The last that begins below a number, or null. */
    Segment lastBefore(long sequence) {
        Map.Entry<Long, Segment> before = byBase.lowerEntry(sequence);
        return before == null ? null : before.getValue();
    }

    Segment first() {
        Map.Entry<Long, Segment> first = byBase.firstEntry();
        return first == null ? null : first.getValue();
    }

    /** The one that holds a sequence number if any does, else the first, or null. */
    Segment holding(long sequence) {
        Map.Entry<Long, Segment> floor = byBase.floorEntry(sequence);
        return floor == null ? first() : floor.getValue();
    }

    Segment after(Segment segment) {
        Map.Entry<Long, Segment> next = byBase.higherEntry(segment.base());
        return next == null ? null : next.getValue();
    }

    /** How many records there are from a sequence number on; numbers that were left out between files count not. */
    long recordsFrom(long sequence) {
        long records = 0;
        for (Segment segment : byBase.values()) {
            records += Math.max(0, segment.end().sequence() - Math.max(sequence, segment.base()));
        }
        return records;
    }

    /** Deletes files that only hold numbers below one; the last stays, it remembers the next number. */
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
