package io.furrow.replay.playback;

import io.furrow.mission.Cursor;

/** What a playback has to know of its recording before it can continue. */
public sealed interface ReadRequest {
    /** The epoch for which it is; an answer for another epoch comes too late. */
    long epoch();

    /** The recording's span. */
    record Open(long epoch) implements ReadRequest {}

    /**
     * The entities' last known states before the point, and the first page from there.
     *
     * @param point epoch ms
     * @param first where the page begins
     * @param primed whether states are requested: nothing is known before the recording's first event
     * @param repeats whether the next epoch is likely to begin at this point, too
     * @param events of the page, at most
     */
    record Begin(long epoch, long point, Cursor first, boolean primed, boolean repeats, int events)
            implements ReadRequest {}

    /**
     * The page after the cursor.
     *
     * @param events at most
     */
    record Next(long epoch, Cursor after, int events) implements ReadRequest {}

    /**
     * The event so many before the cursor.
     *
     * @param first where the replay begins, which is the answer where there are fewer
     * @param count of the events that are requested of the recording
     */
    record Back(long epoch, Cursor from, Cursor first, long count) implements ReadRequest {}
}
