package io.furrow.control.rest;

import java.util.Locale;

import jakarta.ws.rs.WebApplicationException;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.ext.ExceptionMapper;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.text.FailureText;

/** Maps every exception to problem details with {@code error} and {@code reason}. */
public final class JsonExceptionMapper implements ExceptionMapper<Throwable> {
    private static final Logger LOG = LoggerFactory.getLogger(JsonExceptionMapper.class);

    @Override
    public Response toResponse(Throwable failure) {
        Throwable cause = FailureText.unwrap(failure);
        if (cause instanceof ProblemException problem) {
            return problem.response();
        }
        if (cause instanceof WebApplicationException rejected) {
            Response.StatusType status = rejected.getResponse().getStatusInfo();
            String code = status.getReasonPhrase().toLowerCase(Locale.ROOT).replace(' ', '-');
            Response answer = new ProblemException(status.getStatusCode(), code, sentence(status)).response();
            String allowed = rejected.getResponse().getHeaderString("Allow");
            return allowed == null
                    ? answer
                    : Response.fromResponse(answer).header("Allow", allowed).build();
        }
        LOG.error("a request to the REST API failed", cause);
        return new ProblemException(500, "internal-error", "the request failed; the log says why").response();
    }

    private static String sentence(Response.StatusType status) {
        return switch (status.getStatusCode()) {
            case 404 -> "there is no such path; /openapi.json lists all paths";
            case 405 -> "the path does not support this method; /openapi.json lists its methods";
            case 406 -> "the answer is not available in a requested media type; most answers are application/json only";
            case 415 -> "a body must be application/json, that of a PATCH may be application/merge-patch+json";
            default -> "the request was rejected: " + status.getReasonPhrase();
        };
    }
}
