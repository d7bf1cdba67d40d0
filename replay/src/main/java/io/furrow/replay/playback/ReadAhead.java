package io.furrow.replay.playback;

import java.util.ArrayDeque;
import java.util.Deque;

import io.furrow.mission.Cursor;

/** The events that come next: at most what is left of one page, and the page after it. */
final class ReadAhead {
    /** Events of a page at least: each is a question. */
    static final int MIN_EVENTS = 32;

    private final Deque<ReadyEvent> events = new ArrayDeque<>();
    private Cursor loaded;
    private int newest;
    /** Events of the recording in a millisecond of event time, of the newest page; 0 while that is not known. */
    private double density;
    /** Whether the newest page was the last one of the recording when it was read. */
    private boolean complete;
    /** Whether there was still no more when all had been played: a mission may be recorded while it is replayed. */
    private boolean confirmed;

    /** @param from where the first page begins */
    ReadAhead(Cursor from) {
        this.loaded = from;
    }

    void add(ReadyPage page) {
        boolean drained = complete && events.isEmpty();
        events.addAll(page.events());
        newest = page.events().size();
        density = page.read() < 2 ? density : page.read() / Math.max(1.0, page.span());
        loaded = page.next();
        complete = page.last();
        confirmed = drained && complete && newest == 0;
    }

    /**
     * Whether the following page should be read.
     *
     * @param to epoch ms, after the last event that is requested
     */
    boolean wantsMore(long to) {
        if (complete) {
            return !confirmed && events.isEmpty() && loaded.time() < to;
        }
        return loaded.time() < to && events.size() <= newest;
    }

    /** How many events a page of so much event time, ms, has if the recording goes on as it was. */
    int expected(double millis) {
        if (Double.isInfinite(millis)) {
            return Integer.MAX_VALUE;
        }
        return (int) Math.max(MIN_EVENTS, Math.min(Integer.MAX_VALUE, Math.ceil(density * millis)));
    }

    Cursor loaded() {
        return loaded;
    }

    /** The next event; null if it is not known. */
    ReadyEvent peek() {
        return events.peek();
    }

    void remove() {
        events.remove();
    }

    /** Whether nothing comes any more before this event time, epoch ms. */
    boolean isOver(long to) {
        return events.isEmpty()
                ? confirmed || loaded.time() >= to
                : events.peek().time() >= to;
    }
}
