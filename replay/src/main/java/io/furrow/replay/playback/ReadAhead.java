package io.furrow.replay.playback;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Set;

import io.furrow.flink.time.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.Page;
import io.furrow.mission.Skipped;
import io.furrow.mission.StoredEvent;

/** The events that come next: at most what is left of one page, and the page after it. */
final class ReadAhead {
    private final Set<String> devices;
    private final Deque<StoredEvent> events = new ArrayDeque<>();
    private Cursor loaded;
    private int newest;
    /** Whether the newest page was the last one of the recording when it was read. */
    private boolean complete;
    /** Whether there was still no more when all had been played: a mission may be recorded while it is replayed. */
    private boolean confirmed;

    /**
     * @param devices ids of the entities whose events count; empty for all
     * @param from where the first page begins
     */
    ReadAhead(Set<String> devices, Cursor from) {
        this.devices = devices;
        this.loaded = from;
    }

    /** @return how many of its records are no events that can be played */
    long add(Page page) {
        boolean drained = complete && events.isEmpty();
        long skipped = page.skipped().stream().mapToLong(Skipped::count).sum();
        newest = 0;
        for (StoredEvent event : page.events()) {
            if (event.time() < 0 || event.time() >= Epochs.SPAN) { // no timestamp of a record could say it
                skipped++;
            } else if (isWanted(event)) {
                events.add(event);
                newest++;
            }
        }
        loaded = page.next();
        complete = page.last();
        confirmed = drained && complete && newest == 0;
        return skipped;
    }

    boolean isWanted(StoredEvent event) {
        return devices.isEmpty() || devices.contains(event.entityId());
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

    Cursor loaded() {
        return loaded;
    }

    /** The next event; null if it is not known. */
    StoredEvent peek() {
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
