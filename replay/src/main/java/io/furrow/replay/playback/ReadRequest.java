package io.furrow.replay.playback;

import io.furrow.mission.Cursor;

/** A request of a playback to read its recording. */
public sealed interface ReadRequest {
    /** Returns the epoch of the request; results of other epochs are ignored. */
    long epoch();

    /** Requests the recording's extent. */
    record Open(long epoch) implements ReadRequest {}

    /**
     * Requests the last states of the entities before the point, and the first page from there.
     *
     * @param point epoch ms
     * @param first beginning of the page
     * @param primed whether states are requested; there are none before the recording's first event
     * @param repeats whether the next epoch probably begins at this point, too
     * @param events maximum of the page
     */
    record Begin(long epoch, long point, Cursor first, boolean primed, boolean repeats, int events)
            implements ReadRequest {}

    /**
     * Requests the page after the cursor.
     *
     * @param events maximum of the page
     */
    record Next(long epoch, Cursor after, int events) implements ReadRequest {}

    /**
     * Requests the position of the event {@code count} events before the cursor.
     *
     * @param first beginning of the replay, returned if there are fewer events
     * @param count number of events of the replay's devices
     */
    record Back(long epoch, Cursor from, Cursor first, long count) implements ReadRequest {}
}
