package io.furrow.mission;

/** The reading thread was interrupted: its result is not wanted any more. The thread stays interrupted. */
public final class RecordingInterruptedException extends RecordingException {
    private static final long serialVersionUID = 1L;

    private static final String MESSAGE = "Reading of a recording was interrupted";

    private RecordingInterruptedException(Throwable cause) {
        super(MESSAGE, cause);
    }

    /** What a library made of the interrupt. */
    public static RecordingInterruptedException of(Throwable cause) {
        Thread.currentThread().interrupt();
        return new RecordingInterruptedException(cause);
    }

    /** Called between pages by what reads many of them. */
    public static void check() throws RecordingInterruptedException {
        if (Thread.currentThread().isInterrupted()) {
            throw new RecordingInterruptedException(null);
        }
    }
}
