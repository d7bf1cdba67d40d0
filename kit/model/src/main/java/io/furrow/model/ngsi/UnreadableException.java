package io.furrow.model.ngsi;

import java.util.Objects;

/**
 * Thrown if input is unreadable: it becomes a dead letter and is never retried. It has no stack trace, because it
 * concerns the input, of which there may be much, not the program.
 */
public class UnreadableException extends Exception {
    private static final long serialVersionUID = 1L;

    private final Reason reason;

    public UnreadableException(Reason reason, String message) {
        this(reason, message, null);
    }

    public UnreadableException(Reason reason, String message, Throwable cause) {
        super(message, cause, false, false);
        this.reason = Objects.requireNonNull(reason);
    }

    public Reason reason() {
        return reason;
    }
}
