package io.furrow.mission;

/** A recording has been deleted since it was opened, or can never be one: reading it again does not help. */
public final class RecordingDeletedException extends RecordingException {
    private static final long serialVersionUID = 1L;

    public RecordingDeletedException(String message) {
        super(message);
    }
}
