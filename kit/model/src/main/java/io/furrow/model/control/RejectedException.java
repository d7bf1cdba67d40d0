package io.furrow.model.control;

import java.util.Objects;

/** A request that is not granted; the message is the sentence that the answer gives as {@code reason}. */
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
