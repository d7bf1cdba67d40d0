package io.furrow.mission;

import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

/**
 * A stored mission: its events in the order of {@link EventOrder}. Read by one thread. After a {@link
 * RecordingException} the same page can be read again.
 */
public interface Recording extends AutoCloseable {
    /**
     * Returns the first and the last event time; empty if there is no event.
     *
     * @throws RecordingException if the recording is unavailable
     */
    Optional<RecordingExtent> span() throws RecordingException;

    /**
     * Reads the page after the cursor. It has at least one event unless the recording ends there or the page skips as
     * many records as it may have events.
     *
     * @throws RecordingDeletedException if the recording was deleted after it was opened
     * @throws RecordingInterruptedException if the thread is interrupted while it waits
     * @throws RecordingException if the recording is unavailable
     */
    EventPage read(Cursor after, PageLimits limits) throws RecordingException;

    /**
     * Returns the position after the matching event that has exactly {@code count} matching events between itself and a
     * cursor. This implementation reads all pages up to the cursor; recordings that can read backwards override it. The
     * next page may start a new query.
     *
     * @param from events up to this cursor are counted
     * @param first beginning of the recording for this purpose, {@link Cursor#START} or later; returned if there are
     * not enough events
     * @param count from 1 to {@value StepBack#MAX}
     * @param desired called for the events in any order, for some twice
     * @throws IllegalArgumentException for any other count
     * @throws RecordingInterruptedException if the thread is interrupted
     * @throws RecordingException if the recording is unavailable
     */
    default Cursor back(Cursor from, Cursor first, long count, Predicate<StoredEvent> desired, PageLimits limits)
            throws RecordingException {
        StepBack.check(count);
        StepBack back = new StepBack(first, count);
        EventPage eventPage;
        Cursor next = first;
        do {
            RecordingInterruptedException.check();
            eventPage = read(next, limits);
            for (StoredEvent event : eventPage.events()) {
                if (Cursor.after(event).compareTo(from) <= 0) {
                    back.add(Cursor.after(event), desired.test(event));
                }
            }
            next = eventPage.next();
        } while (!eventPage.last() && next.compareTo(from) < 0);
        return back.oldest();
    }

    /**
     * Returns the last state of each entity before a point, with time, id and headers of its newest event, in the order
     * of these events. This implementation reads the recording from its beginning; recordings that can find the newest
     * events of an entity override it. The next page may start a new query.
     *
     * @param time epoch ms, exclusive
     * @param entities ids of the requested entities; empty for all
     * @throws RecordingInterruptedException if the thread is interrupted
     * @throws RecordingException if the recording is unavailable
     */
    default List<StoredEvent> stateBefore(long time, Set<String> entities, PageLimits limits)
            throws RecordingException {
        return LatestState.before(this, time, entities, limits);
    }

    @Override
    void close();
}
