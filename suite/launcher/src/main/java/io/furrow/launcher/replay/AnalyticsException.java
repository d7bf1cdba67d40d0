package io.furrow.launcher.replay;

/** A job could not be started, listed or ended; the message says why and what to do. */
public final class AnalyticsException extends Exception {
    private static final long serialVersionUID = 1L;

    public AnalyticsException(String message) {
        super(message);
    }

    public AnalyticsException(String message, Throwable cause) {
        super(message, cause);
    }
}
