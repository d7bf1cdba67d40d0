package io.furrow.control.rest;

import io.furrow.model.control.ErrorCode;

/** A request that is answered with an error; the message is its {@code reason}. */
final class ProblemException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final int status;
    private final String error;

    /** @param status of HTTP @param error the code in the answer */
    ProblemException(int status, String error, String reason) {
        super(reason);
        this.status = status;
        this.error = error;
    }

    ProblemException(ErrorCode code, String reason) {
        this(statusOf(code.code()), code.code(), reason);
    }

    /** Which status an error of a manager has in HTTP: 400 for what is not understood, 404 for what is not there, else 409. */
    static int statusOf(String code) {
        return switch (code) {
            case "not-json", "not-a-request", "unknown-command", "missing-member", "wrong-member", "illegal-name" ->
                400;
            default -> code.startsWith("unknown-") ? 404 : 409;
        };
    }

    static ProblemException notReady() {
        return new ProblemException(
                503, "not-ready", "the control plane has not read its topics yet; ask again in a moment");
    }

    int status() {
        return status;
    }

    String error() {
        return error;
    }
}
