package io.furrow.control.rest.access;

import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.eclipse.jetty.http.HttpStatus;

import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;

/** Describes a rejection or failure as RFC 9457 defines it, with {@code error}, {@code reason} and what it is about. */
public final class ProblemDetails {
    public static final String TYPE = "application/problem+json";

    /** Members of the answer of a manager that mean something else in RFC 9457. */
    private static final List<String> REPLACED = List.of("type", "status");

    private ProblemDetails() {}

    /** @param answer an error, as a manager answers it */
    public static byte[] of(int status, CommandResult answer) {
        ObjectNode problem = NgsiJson.object()
                .put("type", "about:blank")
                .put("title", HttpStatus.getMessage(status))
                .put("status", status)
                .put("detail", answer.json().path("reason").asText());
        ObjectNode members = answer.json().deepCopy();
        problem.setAll(members.remove(REPLACED));
        return NgsiJson.write(problem);
    }
}
