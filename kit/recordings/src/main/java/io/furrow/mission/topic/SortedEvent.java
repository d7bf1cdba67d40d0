package io.furrow.mission.topic;

import java.io.DataInputStream;
import java.io.DataOutputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.Comparator;

import io.furrow.mission.Cursor;

/**
 * An event of a topic to be sorted.
 *
 * @param at its place in the order
 * @param partition with the offset, orders duplicates
 * @param line of the archive
 */
record SortedEvent(Cursor at, int partition, long offset, byte[] line) {
    static final Comparator<SortedEvent> ORDER = Comparator.comparing(SortedEvent::at)
            .thenComparingInt(SortedEvent::partition)
            .thenComparingLong(SortedEvent::offset);

    /** Bytes of the object in addition to its text. */
    private static final int OVERHEAD = 120;

    /** Returns the approximate bytes in memory. */
    int bytes() {
        return OVERHEAD + 2 * at.id().length() + line.length;
    }

    void write(DataOutputStream out) throws IOException {
        byte[] id = at.id().getBytes(StandardCharsets.UTF_8);
        out.writeLong(at.time());
        out.writeInt(id.length);
        out.write(id);
        out.writeInt(partition);
        out.writeLong(offset);
        out.writeInt(line.length);
        out.write(line);
    }

    static SortedEvent read(DataInputStream in) throws IOException {
        long time = in.readLong();
        byte[] id = in.readNBytes(in.readInt());
        int partition = in.readInt();
        long offset = in.readLong();
        byte[] line = in.readNBytes(in.readInt());
        return new SortedEvent(new Cursor(time, new String(id, StandardCharsets.UTF_8)), partition, offset, line);
    }
}
