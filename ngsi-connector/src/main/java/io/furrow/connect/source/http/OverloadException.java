package io.furrow.connect.source.http;

/**
 * A notification did not become durable within the hold time of its sender. It has no stack trace, because there may be
 * many.
 */
final class OverloadException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean late;

    private OverloadException(String message, boolean late) {
        super(message, null, false, false);
        this.late = late;
    }

    /** The records were not accepted. */
    static OverloadException noRoom() {
        return new OverloadException("there was no room in time", false);
    }

    /** The records were accepted and may still become durable. */
    static OverloadException late() {
        return new OverloadException("it was not durable in time", true);
    }

    boolean isLate() {
        return late;
    }
}
