package io.furrow.replay.playback;

import java.util.List;
import java.util.Optional;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingExtent;

/** The result of a {@link ReadRequest} of the same epoch. */
public sealed interface ReadResult {
    long epoch();

    /** @param span empty if the recording has no event */
    record Opened(long epoch, Optional<RecordingExtent> span) implements ReadResult {}

    /** @param primes last states of the entities, in the same order in each read */
    record Primed(long epoch, List<ReadyEvent> primes, ReadyPage first) implements ReadResult {}

    record NextPage(long epoch, ReadyPage page) implements ReadResult {}

    /**
     * @param count as requested
     * @param found position after the event; the replay's beginning if there are fewer events
     */
    record SteppedBack(long epoch, long count, Cursor found) implements ReadResult {}

    /** The recording is unavailable; the reader retries and sends the result later. */
    record Unavailable(long epoch, String reason) implements ReadResult {}

    /** The read can never succeed: the mission does not exist or was deleted. */
    record Failed(long epoch, String reason) implements ReadResult {}
}
