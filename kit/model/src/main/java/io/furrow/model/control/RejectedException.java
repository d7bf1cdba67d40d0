package io.furrow.model.control;

import java.util.Objects;

/** Thrown if a request is rejected; the message is the member {@code reason} of the answer. */
public final class RejectedException extends Exception {
    private static final long serialVersionUID = 1L;

    private final ErrorCode code;

    public RejectedException(ErrorCode code, String reason) {
        super(reason);
        this.code = Objects.requireNonNull(code);
    }

    public ErrorCode code() {
        return code;
    }
}
