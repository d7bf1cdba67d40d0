package io.furrow.control.rest;

import java.net.URI;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.Priority;
import jakarta.ws.rs.HttpMethod;
import jakarta.ws.rs.Priorities;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.ContainerResponseContext;
import jakarta.ws.rs.container.ContainerResponseFilter;
import jakarta.ws.rs.core.EntityTag;
import jakarta.ws.rs.core.HttpHeaders;
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

    /** Returns a resource with its sequence as entity tag, for {@code If-Match}. */
    static Response one(ObjectNode resource) {
        return json(200, resource)
                .tag(new EntityTag(resource.path("sequence").asText()))
                .build();
    }

    /** Returns a list, of which {@link PageFilter} writes what the request asks for. */
    static Response ok(Stream<? extends JsonNode> elements) {
        ArrayNode array = NgsiJson.array();
        elements.forEach(array::add);
        return Response.ok(array, MediaType.APPLICATION_JSON_TYPE).build();
    }

    static Response.ResponseBuilder json(int status, JsonNode json) {
        return Response.status(status).type(MediaType.APPLICATION_JSON_TYPE).entity(NgsiJson.write(json));
    }

    static Response of(CommandResult answer) {
        return answer.error()
                .map(error -> ProblemException.response(error, answer))
                .orElseGet(() -> json(200, answer.json()).build());
    }

    /**
     * Returns the answer of a manager with the location of the created resource, unless it is of a dry run.
     *
     * @param path of the collection, relative to the request because of proxies
     * @param member with the name
     */
    static Response created(ContainerRequestContext request, CommandResult answer, String path, String member) {
        if (answer.error().isPresent()) {
            return of(answer);
        }
        Response.ResponseBuilder created = json(201, answer.json());
        if (answer.isDryRun()) {
            return created.build();
        }
        return created.location(
                        location(request, path, answer.json().path(member).asText()))
                .build();
    }

    /** Returns the location of a resource of a collection, which a request may have written with a slash at its end. */
    static URI location(ContainerRequestContext request, String path, String name) {
        boolean inside = request.getUriInfo().getRequestUri().getRawPath().endsWith("/");
        return UriBuilder.fromPath(inside ? "../" + path : path).segment(name).build();
    }

    /** Gives answers to HEAD the length of those to GET; else the HTTP server adds that of an empty one. */
    @Priority(Priorities.AUTHENTICATION) // after all that changes answers
    static final class HeadLength implements ContainerResponseFilter {
        @Override
        public void filter(ContainerRequestContext request, ContainerResponseContext response) {
            if (HttpMethod.HEAD.equals(request.getMethod()) && response.getEntity() instanceof byte[] answer) {
                response.getHeaders().putSingle(HttpHeaders.CONTENT_LENGTH, answer.length);
            }
        }
    }
}
