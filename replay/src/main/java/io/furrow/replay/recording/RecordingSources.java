package io.furrow.replay.recording;

import java.io.Serializable;
import java.util.Optional;

import io.furrow.mission.Recording;
import io.furrow.mission.RecordingException;
import io.furrow.mission.Recordings;
import io.furrow.model.control.DesiredReplay;

/** Finds the recording of a replay, wherever it is. Serializable, so that a job can carry it. */
public interface RecordingSources extends Serializable {
    /**
     * Empty if there is none.
     *
     * @throws RecordingException if it cannot be determined now
     */
    Optional<Recording> open(DesiredReplay replay) throws RecordingException;

    /** Recordings by the name of the mission alone. */
    static RecordingSources of(Recordings missions) {
        return replay -> missions.open(replay.mission());
    }
}
