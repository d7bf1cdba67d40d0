package io.furrow.mission;

import java.util.Optional;

/**
 * A stored mission: its events in the order of {@link EventOrder}. Read by one thread. After a {@link RecordingException} the
 * same page can be asked for again.
 */
public interface Recording extends AutoCloseable {
    /**
     * The first and the last event time and the number of events; empty where there is none.
     *
     * @throws RecordingException if the recording cannot be read now
     */
    Optional<Span> span() throws RecordingException;

    /**
     * The page that begins after the cursor. Holds at least one event unless the recording ends there or the page skips as many
     * records as it may hold events.
     *
     * @throws RecordingGoneException if the recording has been deleted since it was opened
     * @throws RecordingException if the recording cannot be read now
     */
    Page read(Cursor after, PageLimits limits) throws RecordingException;

    @Override
    void close();
}
