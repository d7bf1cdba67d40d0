package io.furrow.mission;

import java.io.Serializable;
import java.util.Optional;

/** Opens recordings by mission name. Serializable, so that a job can carry it. */
public interface Recordings extends Serializable {
    /**
     * Empty if the mission is unknown.
     *
     * @throws RecordingException if it cannot be determined now
     */
    Optional<Recording> open(String mission) throws RecordingException;
}
