package io.furrow.connect.source;

/** A notification did not become durable within the time that its sender waits; no stack, there may be many. */
final class OverloadException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final boolean late;

    private OverloadException(String message, boolean late) {
        super(message, null, false, false);
        this.late = late;
    }

    /** Nothing was taken. */
    static OverloadException noRoom() {
        return new OverloadException("there was no room in time", false);
    }

    /** It was taken, and may become durable after all. */
    static OverloadException late() {
        return new OverloadException("it was not durable in time", true);
    }

    boolean isLate() {
        return late;
    }
}
