package io.furrow.control.rest;

import io.furrow.control.rest.access.Caller;
import io.furrow.model.control.ErrorCode;

/** A request that is answered with an error; the message is its {@code reason}. */
public final class ProblemException extends RuntimeException {
    private static final long serialVersionUID = 1L;

    private final int status;
    private final String error;

    /** @param status of HTTP @param error the code in the answer */
    public ProblemException(int status, String error, String reason) {
        super(reason);
        this.status = status;
        this.error = error;
    }

    public ProblemException(ErrorCode code, String reason) {
        this(statusOf(code.code()), code.code(), reason);
    }

    /** Which status an error of a manager has in HTTP: 400 for what is not understood, 404 for what is not there, and so on. */
    static int statusOf(String code) {
        return switch (code) {
            case "not-json", "not-a-request", "unknown-command", "missing-member", "wrong-member", "illegal-name" ->
                400;
            case "no-credentials" -> 404;
            case "too-large" -> 413;
            case "request-id-reused" -> 422;
            case "internal-error" -> 500;
            case "overloaded" -> 503;
            case "quota-exceeded" -> 507;
            default -> code.startsWith("unknown-") ? 404 : 409;
        };
    }

    public static ProblemException overloaded() {
        return new ProblemException(
                ErrorCode.OVERLOADED, "too many requests wait to be carried out; ask again in a moment");
    }

    public static ProblemException keyReused() {
        return new ProblemException(
                ErrorCode.REQUEST_ID_REUSED,
                "the header %s was given to another request, or by somebody else; give each request its own"
                        .formatted(Caller.KEY));
    }

    /** @param bytes below 0 if they were not counted */
    public static ProblemException tooLarge(long bytes, int most) {
        return new ProblemException(
                ErrorCode.TOO_LARGE,
                "the request has %s bytes, and may have %d; send a long list of devices or fields in several requests"
                        .formatted(bytes < 0 ? "more" : Long.toString(bytes), most));
    }

    public static ProblemException notReady() {
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
