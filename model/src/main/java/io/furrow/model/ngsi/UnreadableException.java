package io.furrow.model.ngsi;

import java.util.Objects;

/** Input that cannot be understood: it becomes a dead letter and is never tried again. */
public class UnreadableException extends Exception {
    private static final long serialVersionUID = 1L;

    private final Reason reason;

    public UnreadableException(Reason reason, String message) {
        this(reason, message, null);
    }

    public UnreadableException(Reason reason, String message, Throwable cause) {
        super(message, cause);
        this.reason = Objects.requireNonNull(reason);
    }

    public Reason reason() {
        return reason;
    }
}
