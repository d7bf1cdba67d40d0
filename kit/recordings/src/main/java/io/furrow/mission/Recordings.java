package io.furrow.mission;

import java.io.Serializable;
import java.util.Optional;

/** Opens recordings by mission name. Serializable, so that a job can carry it. */
public interface Recordings extends Serializable {
    /**
     * Opens the recording of a mission; empty if it does not exist.
     *
     * @throws RecordingException if that cannot be determined now
     */
    Optional<Recording> open(String mission) throws RecordingException;
}
