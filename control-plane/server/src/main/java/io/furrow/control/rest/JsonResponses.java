package io.furrow.control.rest;

import java.net.URI;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.core.UriBuilder;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.model.control.CommandResult;
import io.furrow.model.ngsi.NgsiJson;

/** Answers in JSON. */
final class JsonResponses {
    private JsonResponses() {}

    static Response ok(JsonNode json) {
        return json(200, json).build();
    }

    static Response ok(Stream<? extends JsonNode> elements) {
        ArrayNode array = NgsiJson.array();
        elements.forEach(array::add);
        return ok(array);
    }

    static Response.ResponseBuilder json(int status, JsonNode json) {
        return Response.status(status).type(MediaType.APPLICATION_JSON_TYPE).entity(NgsiJson.write(json));
    }

    /** What a manager answered. */
    static Response of(CommandResult answer) {
        return answer.error()
                .map(error -> ProblemException.response(error, answer.json()))
                .orElseGet(() -> json(200, answer.json()).build());
    }

    /** What a manager answered, and where that is now. @param path before the name @param member with the name */
    static Response created(CommandResult answer, String path, String member) {
        if (answer.error().isPresent()) {
            return of(answer);
        }
        URI location = UriBuilder.fromPath(path)
                .segment(answer.json().path(member).asText())
                .build();
        return json(201, answer.json()).location(location).build();
    }
}
