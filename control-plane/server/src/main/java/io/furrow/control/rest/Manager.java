package io.furrow.control.rest;

import java.util.OptionalLong;
import java.util.concurrent.CompletionStage;
import java.util.regex.Matcher;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.HttpHeaders;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.Requests;

/** Sends requests to a manager. */
record Manager(CommandClient client, String topic) {
    /** A proxy that compresses answers makes tags weak. */
    private static final Pattern ENTITY_TAG = Pattern.compile("(?:W/)?\"([0-9]{1,18})\"");

    /** @param members of the request, except type, command, id, user and whether it is a dry run */
    CompletionStage<CommandResult> request(ContainerRequestContext request, String command, ObjectNode members) {
        if ("true".equals(request.getUriInfo().getQueryParameters().getFirst(CommandResult.DRY_RUN))) {
            members.put(CommandResult.DRY_RUN, true);
        }
        ifSequence(request).ifPresent(sequence -> members.put(Requests.IF_SEQUENCE, sequence));
        return client.request(new CommandClient.CommandRequest(topic, command, members), RequestContext.of(request));
    }

    /** Returns the sequence of {@code If-Match}, one entity tag as {@link JsonResponses#one} gives it. */
    private static OptionalLong ifSequence(ContainerRequestContext request) {
        String tag = request.getHeaderString(HttpHeaders.IF_MATCH);
        if (tag == null) {
            return OptionalLong.empty();
        }
        Matcher matcher = ENTITY_TAG.matcher(tag);
        if (!matcher.matches()) {
            throw new ProblemException(
                    400, "wrong-header", "If-Match must be one ETag of an answer, for instance \"17\"");
        }
        return OptionalLong.of(Long.parseLong(matcher.group(1)));
    }

    /** Sends a request and returns the manager's answer as response. */
    CompletionStage<Response> command(ContainerRequestContext request, String command, ObjectNode members) {
        return request(request, command, members).thenApply(JsonResponses::of);
    }
}
