package io.furrow.mission;

import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.function.Predicate;

/**
 * A stored mission: its events in the order of {@link EventOrder}. Read by one thread. After a {@link RecordingException} the
 * same page can be asked for again.
 */
public interface Recording extends AutoCloseable {
    /**
     * The first and the last event time; empty if there is none.
     *
     * @throws RecordingException if the recording cannot be read now
     */
    Optional<RecordingExtent> span() throws RecordingException;

    /**
     * The page that begins after the cursor. Holds at least one event unless the recording ends there or the page skips as many
     * records as it may hold events.
     *
     * @throws RecordingDeletedException if the recording has been deleted since it was opened
     * @throws RecordingInterruptedException if the thread is interrupted while it waits
     * @throws RecordingException if the recording cannot be read now
     */
    EventPage read(Cursor after, PageLimits limits) throws RecordingException;

    /**
     * The cursor that lies {@code count} wanted events before another, just after a wanted event: exactly these lie between the two. Here
     * by reading all pages between; a recording that can read backwards does so. The next page may begin again.
     *
     * @param from events up to this cursor are counted
     * @param first where the recording is taken to begin: {@link Cursor#START} or later, the answer where no more events are requested
     * @param count from 1 to {@value StepBack#MAX}
     * @param desired asked for the events in any order, for some twice
     * @throws IllegalArgumentException for any other count
     * @throws RecordingInterruptedException if the thread is interrupted meanwhile
     * @throws RecordingException if the recording cannot be read now
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
     * The entities as they were known before a point, each with time, id and headers of its newest event, in the order of these. Here by
     * reading the recording from its beginning; one that finds an entity's newest events otherwise does so. The next page may begin again.
     *
     * @param time epoch ms; events of this time are not among what was known
     * @param entities ids of those that are requested; empty for all
     * @throws RecordingInterruptedException if the thread is interrupted meanwhile
     * @throws RecordingException if the recording cannot be read now
     */
    default List<StoredEvent> stateBefore(long time, Set<String> entities, PageLimits limits)
            throws RecordingException {
        return LatestState.before(this, time, entities, limits);
    }

    @Override
    void close();
}
