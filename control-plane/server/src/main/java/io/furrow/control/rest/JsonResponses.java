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

/** Creates responses in JSON. */
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

    static Response of(CommandResult answer) {
        return answer.error()
                .map(error -> ProblemException.response(error, answer.json()))
                .orElseGet(() -> json(200, answer.json()).build());
    }

    /**
     * Returns the answer of a manager with the location of the created resource.
     *
     * @param path of the collection
     * @param member with the name
     */
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
