package io.furrow.mission;

/** Thrown if a recording was deleted after it was opened, or can never be read, so that a retry does not help. */
public final class RecordingDeletedException extends RecordingException {
    private static final long serialVersionUID = 1L;

    public RecordingDeletedException(String message) {
        super(message);
    }
}
