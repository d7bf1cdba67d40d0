package io.furrow.connect.journal;

/** The reason why records did not become durable; it has no stack trace, because every waiting sender may get one. */
public abstract sealed class JournalException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private JournalException(String message, Throwable cause) {
        super(message, cause, false, false);
    }

    /** The journal was closed before; the records were not written. */
    public static final class Closed extends JournalException {
        private static final long serialVersionUID = 1L;

        Closed() {
            super("the journal is closed", null);
        }
    }

    /** The disk turned out to be full; the records were not written. */
    public static final class NoRoom extends JournalException {
        private static final long serialVersionUID = 1L;

        NoRoom(Throwable cause) {
            super("the disk is full", cause);
        }
    }

    /** The disk reported an error. The records may be found after the next opening, or not. */
    public static final class DiskFailed extends JournalException {
        private static final long serialVersionUID = 1L;

        DiskFailed(Throwable cause) {
            super("the disk failed: " + cause.getMessage(), cause);
        }
    }
}
