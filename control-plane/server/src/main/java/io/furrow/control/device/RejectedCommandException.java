package io.furrow.control.device;

import java.io.IOException;

/** Thrown if the context broker rejects a command permanently; the message is a sentence that says why. */
public final class RejectedCommandException extends IOException {
    private static final long serialVersionUID = 1L;

    private final int status;

    RejectedCommandException(int status, String message) {
        super(message);
        this.status = status;
    }

    /** Status of the context broker's response: 400, 404, 409 or 422. */
    public int status() {
        return status;
    }
}
