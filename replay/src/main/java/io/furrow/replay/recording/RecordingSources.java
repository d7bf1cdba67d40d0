package io.furrow.replay.recording;

import java.io.Serializable;
import java.util.Optional;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.Recordings;
import io.furrow.model.control.DesiredReplay;

/** Opens the recordings of replays. Serializable, so that a job can carry it. */
public interface RecordingSources extends Serializable {
    /**
     * Opens the recording of a replay; empty if it does not exist.
     *
     * @throws RecordingException if that cannot be determined now
     */
    Optional<Recording> open(DesiredReplay replay) throws RecordingException;

    /** Returns a source that opens recordings by the mission's name only. */
    static RecordingSources of(Recordings missions) {
        return replay -> missions.open(replay.mission());
    }
}
