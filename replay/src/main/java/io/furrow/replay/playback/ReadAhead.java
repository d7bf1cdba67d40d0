package io.furrow.replay.playback;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;
import java.util.Optional;

import io.furrow.mission.Cursor;
import io.furrow.model.control.DesiredReplay;
import io.furrow.replay.playback.PlaybackState.Phase;

/**
 * What has been read and is to be played: states known before the epoch, and the events that come next, at most what is left of one page
 * and the page after it. Begins anew with each epoch.
 */
final class ReadAhead {
    /** Events of a page at least: each is a question. */
    static final int MIN_EVENTS = 32;

    /** A page is what is played in this time, ms. */
    private static final double PAGE = 2_000;

    private final Deque<ReadyEvent> events = new ArrayDeque<>();
    /** Of each event what was skipped of the pages that it ends: a restart reads again what was not played. */
    private final Deque<Long> skipped = new ArrayDeque<>();
    /** Of pages behind the last event. */
    private long skippedSince;

    private Cursor loaded;
    private int newest;
    /** Events of the recording in a millisecond of event time, of the newest page; 0 while that is not known. */
    private double density;
    /** Whether the newest page was the last one of the recording when it was read. */
    private boolean complete;
    /** Whether there was still no more when all had been played: a mission may be recorded while it is replayed. */
    private boolean confirmed;
    /** Null until they are known, and when they have been played. */
    private List<ReadyEvent> primes;

    private boolean fetching;

    /** @param from where the first page begins */
    ReadAhead(Cursor from) {
        this.loaded = from;
    }

    /** What is to be read next; asked for once. */
    Optional<ReadRequest> fetch(PlaybackState at, DesiredReplay desired) {
        if (fetching) {
            return Optional.empty();
        }
        ReadRequest next = null;
        PendingSteps pendingSteps = new PendingSteps(at, desired);
        int page = expected(PAGE * desired.speed());
        if (at.phase == Phase.OPENING) {
            next = new ReadRequest.Open(at.epoch);
        } else if (at.phase == Phase.PRIMING && primes == null) {
            Cursor from = at.point <= at.first ? Cursor.START : Cursor.before(at.point);
            next = new ReadRequest.Begin(at.epoch, at.point, from, at.point > at.first, desired.loops(), page);
        } else if (pendingSteps.wantsBack()) {
            next = pendingSteps.back();
        } else if (at.phase == Phase.PLAYING && wantsMore(desired.to())) {
            next = new ReadRequest.Next(at.epoch, loaded, page);
        }
        fetching = next != null;
        return Optional.ofNullable(next);
    }

    boolean isFetching() {
        return fetching;
    }

    void answered() {
        fetching = false;
    }

    void setPrimes(List<ReadyEvent> known) {
        primes = known;
    }

    /** Null until they are known, and when they have been played. */
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
     * Whether the following page should be read.
     *
     * @param to epoch ms, after the last event that is requested
     */
    private boolean wantsMore(long to) {
        if (complete) {
            return !confirmed && events.isEmpty() && loaded.time() < to;
        }
        return loaded.time() < to && events.size() <= newest;
    }

    /** How many events a page of so much event time, ms, has if the recording goes on as it was. */
    private int expected(double millis) {
        if (Double.isInfinite(millis)) {
            return Integer.MAX_VALUE;
        }
        return (int) Math.max(MIN_EVENTS, Math.min(Integer.MAX_VALUE, Math.ceil(density * millis)));
    }

    /** The next event; null if it is not known. */
    ReadyEvent peek() {
        return events.peek();
    }

    /** Removes the next event; returns how much was skipped until then. */
    long remove() {
        events.remove();
        return skipped.remove();
    }

    /** How much was skipped of what is not to be played. */
    long skippedOfRest() {
        return skippedSince + skipped.stream().mapToLong(Long::longValue).sum();
    }

    /** Whether nothing comes any more before this event time, epoch ms. */
    boolean isOver(long to) {
        return events.isEmpty()
                ? confirmed || loaded.time() >= to
                : events.peek().time() >= to;
    }
}
