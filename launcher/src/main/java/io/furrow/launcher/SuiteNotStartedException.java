package io.furrow.launcher;

/** The suite cannot run as asked; the message is one sentence with the remedy, fit for the terminal. */
final class SuiteNotStartedException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    SuiteNotStartedException(String message) {
        super(message);
    }

    SuiteNotStartedException(String message, Throwable cause) {
        super(message, cause);
    }
}
