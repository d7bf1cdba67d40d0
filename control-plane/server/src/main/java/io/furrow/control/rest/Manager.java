package io.furrow.control.rest;

import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.model.control.CommandResult;

/** Sends requests to a manager. */
record Manager(CommandClient client, String topic) {
    /** @param members of the request, except type, command, id and user */
    CompletionStage<CommandResult> request(ContainerRequestContext request, String command, ObjectNode members) {
        return client.request(new CommandClient.CommandRequest(topic, command, members), RequestContext.of(request));
    }

    /** Sends a request and returns the manager's answer as response. */
    CompletionStage<Response> command(ContainerRequestContext request, String command, ObjectNode members) {
        return request(request, command, members).thenApply(JsonResponses::of);
    }
}
