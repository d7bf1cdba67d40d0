package io.furrow.control.rest.access;

import jakarta.ws.rs.core.Response;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;

/** Thrown to answer a request with an error; the message is its {@code reason}. */
public final class ProblemException extends RuntimeException {
    private static final long serialVersionUID = 1L;
    private static final int RETRY_AFTER_SECONDS = 1;

    private final int status;
    private final String error;

    /** @param status HTTP status @param error code in the answer */
    public ProblemException(int status, String error, String reason) {
        super(reason);
        this.status = status;
        this.error = error;
    }

    public ProblemException(ErrorCode code, String reason) {
        this(statusOf(code.code()), code.code(), reason);
    }

    public static void rejectIf(boolean isWrong, ErrorCode code, String reason) {
        if (isWrong) {
            throw new ProblemException(code, reason);
        }
    }

    /** Maps the error code of a manager to an HTTP status. */
    private static int statusOf(String code) {
        return switch (code) {
            case "not-json", "not-a-request", "unknown-command", "missing-member", "wrong-member", "illegal-name" ->
                400;
            case "no-credentials" -> 404;
            case "outdated" -> 412;
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

    public static ProblemException noMongo() {
        return new ProblemException(
                501,
                "no-mongodb",
                "this control plane was started without --mongo, where missions and their markers are stored");
    }

    public static ProblemException keyReused() {
        return new ProblemException(
                ErrorCode.REQUEST_ID_REUSED,
                "the header %s was given to another request, or by somebody else; give each request its own"
                        .formatted(RequestContext.KEY));
    }

    /** @param bytes negative if unknown */
    public static ProblemException tooLarge(long bytes, int max) {
        return new ProblemException(
                ErrorCode.TOO_LARGE,
                "the request has %s bytes, and may have %d; send a long list of devices or fields in several requests"
                        .formatted(bytes < 0 ? "more" : Long.toString(bytes), max));
    }

    public static ProblemException notReady() {
        return new ProblemException(
                503, "not-ready", "the control plane has not read its topics yet; ask again in a moment");
    }

    public String error() {
        return error;
    }

    public Response response() {
        return response(status, CommandResult.ofError(error, getMessage()));
    }

    /** Returns the response for a rejection of a manager. @param error its code */
    public static Response response(String error, CommandResult rejection) {
        return response(statusOf(error), rejection);
    }

    private static Response response(int status, CommandResult rejection) {
        Response.ResponseBuilder answer =
                Response.status(status).type(ProblemDetails.TYPE).entity(ProblemDetails.of(status, rejection));
        if (status == 503) {
            answer.header("Retry-After", RETRY_AFTER_SECONDS);
        } else if (status == 401) {
            answer.header("WWW-Authenticate", "Bearer");
        }
        return answer.build();
    }
}
