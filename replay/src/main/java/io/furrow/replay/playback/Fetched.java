package io.furrow.replay.playback;

import java.util.List;
import java.util.Optional;

import io.furrow.mission.Cursor;
import io.furrow.mission.Span;

/** The answer to a {@link Fetch} of the same epoch. */
public sealed interface Fetched {
    long epoch();

    /** @param span empty if the recording has no event */
    record Opened(long epoch, Optional<Span> span) implements Fetched {}

    /** @param primes the entities' last known states, in the same order whenever they are read */
    record Begun(long epoch, List<ReadyEvent> primes, ReadyPage first) implements Fetched {}

    record More(long epoch, ReadyPage page) implements Fetched {}

    /**
     * @param count as was asked for
     * @param found just after the event; where the replay begins where there are fewer
     */
    record Back(long epoch, long count, Cursor found) implements Fetched {}

    /** It cannot be read now and is tried again; the answer is still to come. */
    record Waiting(long epoch, String reason) implements Fetched {}

    /** It will never be read: the mission is unknown, or was deleted meanwhile. */
    record Gone(long epoch, String reason) implements Fetched {}
}
