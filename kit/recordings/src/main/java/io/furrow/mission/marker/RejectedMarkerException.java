package io.furrow.mission.marker;

/** Thrown if a marker is not stored. The message says which, why, and what to do. */
public final class RejectedMarkerException extends Exception {
    private static final long serialVersionUID = 1L;

    RejectedMarkerException(String message) {
        super(message);
    }
}
