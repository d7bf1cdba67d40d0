package io.furrow.control.rest;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.Priority;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerRequestFilter;
import jakarta.ws.rs.core.HttpHeaders;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ApiDescription;
import io.furrow.control.rest.description.MemberNames;
import io.furrow.control.rest.description.NearestName;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;

/**
 * Rejects requests with query parameters or members that the description of the API does not have, because a misspelled
 * one would be ignored, and with values of parameters that are not as described. A body may repeat the names of its
 * path, for instance the domain.
 */
@Priority(Priorities.ENTITY_CODER) // after authorization
final class UnknownNameFilter implements ContainerRequestFilter {
    private static final int MAX_QUOTED = 64;

    private final ApiDescription description;

    UnknownNameFilter(ApiDescription description) {
        this.description = description;
    }

    @Override
    public void filter(ContainerRequestContext request) throws IOException {
        Optional<ApiDescription.Operation> operation = description.operation(request);
        if (operation.isEmpty()) {
            return;
        }
        if (request.getHeaderString(HttpHeaders.IF_MATCH) != null
                && !operation.get().headers().contains(HttpHeaders.IF_MATCH)) {
            throw new ProblemException(
                    400, "wrong-header", "If-Match has no meaning here; /openapi.json lists where it has one");
        }
        Map<String, JsonNode> parameters = operation.get().parameters();
        request.getUriInfo().getQueryParameters().forEach((name, values) -> {
            if (!parameters.containsKey(name)) {
                throw unknown("parameter", name, name, parameters.keySet());
            }
            ParameterValues.check(name, values, parameters.get(name));
        });
        if (!operation.get().body().areFree()) {
            byte[] body = JsonBodyReader.bytes(request.getEntityStream(), Limits.REQUEST_BYTES);
            request.setEntityStream(new ByteArrayInputStream(body));
            checkMembers(
                    JsonBodyReader.read(new ByteArrayInputStream(body)),
                    request.getUriInfo().getPathParameters(),
                    operation.get().body());
        }
    }

    private static void checkMembers(ObjectNode body, Map<String, List<String>> path, MemberNames known) {
        path.forEach((name, values) -> {
            JsonNode repeated = body.remove(name);
            ProblemException.rejectIf(
                    repeated != null && !repeated.isNull() && !repeated.asText().equals(values.get(0)),
                    ErrorCode.WRONG_MEMBER,
                    "'%s' must be '%s' as in the path".formatted(name, values.get(0)));
        });
        check("", body, known);
    }

    /** @param at place of the value in the body, for instance {@code devices[3].at}; empty for the whole */
    private static void check(String at, JsonNode value, MemberNames known) {
        if (known.schemas().isEmpty() || !value.isContainerNode()) {
            return;
        }
        if (value.isArray()) {
            MemberNames element = known.ofElement();
            for (int i = 0; i < value.size(); i++) {
                check(at + "[" + i + "]", value.get(i), element);
            }
        }
        Set<String> names = known.names();
        for (Map.Entry<String, JsonNode> member : value.properties()) {
            String name = member.getKey();
            String place = at.isEmpty() ? name : at + "." + name;
            if (!names.contains(name) && !known.areFree()) {
                throw unknown("member", place, name, names);
            }
            if (member.getValue().isContainerNode()) {
                check(place, member.getValue(), known.ofMember(name));
            }
        }
    }

    /** @param place of the name, ends with it @param known names of that place */
    private static ProblemException unknown(String kind, String place, String name, Set<String> known) {
        return new ProblemException(
                400,
                "unknown-" + kind,
                "there is no %s '%s'%s; %s"
                        .formatted(
                                kind,
                                quotable(place),
                                NearestName.of(name, known)
                                        .map(", did you mean '%s'?"::formatted)
                                        .orElse(""),
                                known.isEmpty() ? "none is known" : "known are " + String.join(", ", known)));
    }

    /** Shortens a text, and replaces halves of surrogate pairs, which cannot be written. */
    private static String quotable(String text) {
        String quoted = text.length() <= MAX_QUOTED ? text : text.substring(0, MAX_QUOTED) + "…";
        return new String(quoted.getBytes(StandardCharsets.UTF_8), StandardCharsets.UTF_8);
    }
}
