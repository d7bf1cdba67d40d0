package io.furrow.mission.marker;

/** A marker is not stored. The message says which, why, and what to do. */
public final class RefusedMarkerException extends Exception {
    private static final long serialVersionUID = 1L;

    RefusedMarkerException(String message) {
        super(message);
    }
}
