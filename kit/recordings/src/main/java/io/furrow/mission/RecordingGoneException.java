package io.furrow.mission;

/** A recording has been deleted since it was opened, or can never be one: reading it again does not help. */
public final class RecordingGoneException extends RecordingException {
    private static final long serialVersionUID = 1L;

    public RecordingGoneException(String message) {
        super(message);
    }
}
