package io.furrow.mission;

/** Thrown if the reading thread is interrupted because its result is no longer needed. The thread stays interrupted. */
public final class RecordingInterruptedException extends RecordingException {
    private static final long serialVersionUID = 1L;

    private static final String MESSAGE = "Reading of a recording was interrupted";

    private RecordingInterruptedException(Throwable cause) {
        super(MESSAGE, cause);
    }

    /** Wraps a library's exception for the interrupt and interrupts the thread again. */
    public static RecordingInterruptedException of(Throwable cause) {
        Thread.currentThread().interrupt();
        return new RecordingInterruptedException(cause);
    }

    /** Throws if the thread is interrupted; called between pages. */
    public static void check() throws RecordingInterruptedException {
        if (Thread.currentThread().isInterrupted()) {
            throw new RecordingInterruptedException(null);
        }
    }
}
