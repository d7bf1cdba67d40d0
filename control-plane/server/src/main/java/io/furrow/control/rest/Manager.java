package io.furrow.control.rest;

import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.model.control.CommandResult;

/** A manager that requests are handed on to. */
record Manager(CommandClient client, String topic) {
    /** @param members of the request but its type, command, id and user */
    CompletionStage<CommandResult> request(ContainerRequestContext request, String command, ObjectNode members) {
        return client.request(new CommandClient.CommandRequest(topic, command, members), RequestContext.of(request));
    }

    /** Answers as the manager does. */
    CompletionStage<Response> command(ContainerRequestContext request, String command, ObjectNode members) {
        return request(request, command, members).thenApply(JsonResponses::of);
    }
}
