package io.furrow.replay.playback;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.Optional;

import io.furrow.mission.Cursor;
import io.furrow.model.control.DesiredReplay;
import io.furrow.replay.playback.PlaybackState.Phase;

/** Buffers unplayed states and events of one epoch: at most the rest of one page and the page after it. */
final class ReadAhead {
    /** Minimum events of a page, so that slow replays send few requests. */
    static final int MIN_EVENTS = 32;

    /** Playing time of a page, ms. */
    private static final double PAGE = 2_000;

    private final Deque<ReadyEvent> events = new ArrayDeque<>();
    /** For each event the skipped documents up to it; a restart reads documents behind the last played event again. */
    private final Deque<Long> skipped = new ArrayDeque<>();
    /** Skipped documents behind the last event. */
    private long skippedSince;

    private Cursor loaded;
    private int newest;
    /** Events per millisecond of event time in the newest page; 0 until a page has two events. */
    private double density;
    /** Whether the newest page was the last one of the recording when it was read. */
    private boolean complete;
    /** Whether a second read at the end found no more events: a mission may be recorded while it is replayed. */
    private boolean confirmed;
    /** Null until they are read, and after they were played. */
    private List<ReadyEvent> primes;

    private boolean fetching;

    /** @param from beginning of the first page */
    ReadAhead(Cursor from) {
        this.loaded = from;
    }

    /** Returns the next request, each one once. */
    Optional<ReadRequest> fetch(PlaybackState at, DesiredReplay desired) {
        if (fetching) {
            return Optional.empty();
        }
        ReadRequest next = null;
        PendingSteps pendingSteps = new PendingSteps(at, desired);
        int page = expectedEvents(PAGE * desired.speed());
        if (at.phase == Phase.OPENING) {
            next = new ReadRequest.Open(at.epoch);
        } else if (at.phase == Phase.PRIMING && primes == null) {
            Cursor from = at.point <= at.first ? Cursor.START : Cursor.before(at.point);
            next = new ReadRequest.Begin(at.epoch, at.point, from, at.point > at.first, desired.loops(), page);
        } else if (pendingSteps.isBackwardPending()) {
            next = pendingSteps.back();
        } else if (at.phase == Phase.PLAYING && needsMore(desired.to())) {
            next = new ReadRequest.Next(at.epoch, loaded, page);
        }
        fetching = next != null;
        return Optional.ofNullable(next);
    }

    boolean isFetching() {
        return fetching;
    }

    void completeFetch() {
        fetching = false;
    }

    void setPrimes(List<ReadyEvent> states) {
        primes = states;
    }

    /** Returns null until they are read, and after they were played. */
    List<ReadyEvent> primes() {
        return primes;
    }

    void add(ReadyPage page) {
        boolean drained = complete && events.isEmpty();
        skippedSince += page.skipped();
        for (ReadyEvent event : page.events()) {
            events.add(event);
            skipped.add(0L);
        }
        if (!page.events().isEmpty()) {
            skipped.removeLast();
            skipped.add(skippedSince);
            skippedSince = 0;
        }
        newest = page.events().size();
        density = page.read() < 2 ? density : page.read() / Math.max(1.0, page.span());
        loaded = page.next();
        complete = page.last();
        confirmed = drained && complete && newest == 0;
    }

    /**
     * Returns whether the following page should be read.
     *
     * @param to epoch ms, exclusive end of the requested events
     */
    private boolean needsMore(long to) {
        if (complete) {
            return !confirmed && events.isEmpty() && loaded.time() < to;
        }
        return loaded.time() < to && events.size() <= newest;
    }

    /** Estimates the events in an interval of event time, ms, from the density of the newest page. */
    private int expectedEvents(double millis) {
        if (Double.isInfinite(millis)) {
            return Integer.MAX_VALUE;
        }
        return (int) Math.max(MIN_EVENTS, Math.min(Integer.MAX_VALUE, Math.ceil(density * millis)));
    }

    /** Returns the next event; null if it is not read yet. */
    ReadyEvent peek() {
        return events.peek();
    }

    /** Removes the next event and returns the number of skipped documents up to it. */
    long remove() {
        events.remove();
        return skipped.remove();
    }

    /** Returns the number of skipped documents among the rest, which is not played. */
    long skippedOfRest() {
        return skippedSince + skipped.stream().mapToLong(Long::longValue).sum();
    }

    /** Returns whether no event before this event time, epoch ms, is left. */
    boolean isOver(long to) {
        return events.isEmpty()
                ? confirmed || loaded.time() >= to
                : events.peek().time() >= to;
    }
}
