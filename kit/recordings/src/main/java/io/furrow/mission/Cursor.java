package io.furrow.mission;

import java.io.Serializable;
import java.util.Comparator;

/**
 * A position in a recording: after the event of this time and id, whether or not it exists. Cursors have the order of
 * events.
 *
 * @param time event time, epoch ms
 * @param id event id; empty before all events of that time
 */
public record Cursor(long time, String id) implements Comparable<Cursor>, Serializable {
    /** The position before the first event. */
    public static final Cursor START = before(Long.MIN_VALUE);

    private static final Comparator<Cursor> ORDER =
            Comparator.comparingLong(Cursor::time).thenComparing(Cursor::id);

    /** Returns the position before the first event of this time, epoch ms. */
    public static Cursor before(long time) {
        return new Cursor(time, "");
    }

    /** Returns the position after an event. */
    public static Cursor after(StoredEvent event) {
        return new Cursor(event.time(), event.id());
    }

    @Override
    public int compareTo(Cursor other) {
        return ORDER.compare(this, other);
    }
}
