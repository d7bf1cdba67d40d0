package io.furrow.replay.playback;

import java.util.List;
import java.util.Optional;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingExtent;

/** The answer to a {@link ReadRequest} of the same epoch. */
public sealed interface ReadResult {
    long epoch();

    /** @param span empty if the recording has no event */
    record Opened(long epoch, Optional<RecordingExtent> span) implements ReadResult {}

    /** @param primes the entities' last known states, in the same order whenever they are read */
    record Primed(long epoch, List<ReadyEvent> primes, ReadyPage first) implements ReadResult {}

    record NextPage(long epoch, ReadyPage page) implements ReadResult {}

    /**
     * @param count as was asked for
     * @param found just after the event; where the replay begins where there are fewer
     */
    record SteppedBack(long epoch, long count, Cursor found) implements ReadResult {}

    /** It cannot be read now and is tried again; the answer is still to come. */
    record Unavailable(long epoch, String reason) implements ReadResult {}

    /** It will never be read: the mission is unknown, or was deleted meanwhile. */
    record Failed(long epoch, String reason) implements ReadResult {}
}
