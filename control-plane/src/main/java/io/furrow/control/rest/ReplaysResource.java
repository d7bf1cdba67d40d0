package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.topic.Topics;

/** {@code /api/replays}. */
@Path("/api/replays")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class ReplaysResource {
    private static final String REPLAY = "replay";

    private final ServiceView view;
    private final Managers managers;

    ReplaysResource(ServiceView view, Managers managers) {
        this.view = view;
        this.managers = managers;
    }

    @GET
    public Response list() {
        return Replies.ok(view.all(Topics.REPLAYS).map(this::withStatus));
    }

    @POST
    public CompletionStage<Response> start(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return ask("start", Body.read(body), request)
                .thenApply(answer -> Replies.created(answer, "/api/replays", REPLAY));
    }

    @GET
    @Path("{replay}")
    public Response get(@PathParam(REPLAY) String replay) {
        return Replies.ok(withStatus(view.find(Topics.REPLAYS, replay)
                .orElseThrow(() -> new ProblemException(
                        ErrorCode.UNKNOWN_REPLAY, "there is no replay '%s', or it is over".formatted(replay)))));
    }

    @DELETE
    @Path("{replay}")
    public CompletionStage<Response> stop(@Context ContainerRequestContext request, @PathParam(REPLAY) String replay) {
        return steer("stop", replay, JsonNodeFactory.instance.objectNode(), request);
    }

    /** @param command {@code to} belongs to {@code seek}, {@code speed} to {@code speed}, {@code count} to {@code step} */
    @POST
    @Path("{replay}/{command: pause|resume|seek|speed|step}")
    public CompletionStage<Response> steer(
            @Context ContainerRequestContext request,
            @PathParam(REPLAY) String replay,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return steer(command, replay, Body.read(body), request);
    }

    private CompletionStage<Response> steer(
            String command, String replay, ObjectNode members, ContainerRequestContext request) {
        return ask(command, members.put(REPLAY, replay), request).thenApply(answer -> Replies.of(answer, 200));
    }

    private ObjectNode withStatus(ObjectNode wanted) {
        view.find(Topics.REPLAYS_STATUS, wanted.path(REPLAY).asText())
                .ifPresent(status -> wanted.set("status", status));
        return wanted;
    }

    private CompletionStage<io.furrow.model.control.Response> ask(
            String command, ObjectNode members, ContainerRequestContext request) {
        return managers.ask(new Managers.Question(Topics.REPLAY_MANAGER, command, members), Caller.of(request));
    }
}
