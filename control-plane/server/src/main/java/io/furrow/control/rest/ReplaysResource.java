package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletionStage;
import java.util.function.UnaryOperator;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.ReplayStatusView;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code /api/replays}, and {@code /api/replays/groups} for replays that follow a common clock. */
@Path("/api/replays")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class ReplaysResource {
    private static final String REPLAY = ReplayStatusView.REPLAY;
    private static final String GROUP = ReplayStatusView.GROUP;
    private static final String COMMANDS = "/{command: pause|resume|seek|speed|step|loop}";

    private final ReplayStatusView replays;
    private final Manager manager;
    private final StateWait waits;

    ReplaysResource(ReplayStatusView replays, CommandClient managers, StateWait waits) {
        this.waits = waits;
        this.replays = replays;
        this.manager = new Manager(managers, Topics.REPLAY_MANAGER);
    }

    @GET
    public Response list() {
        return JsonResponses.ok(replays.all());
    }

    @POST
    public CompletionStage<Response> start(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.request(request, "start", JsonBodyReader.read(body))
                .thenApply(answer -> answer.json().has(GROUP)
                        ? JsonResponses.created(request, answer, "replays/groups", GROUP)
                        : JsonResponses.created(request, answer, "replays", REPLAY));
    }

    /**
     * Returns a replay.
     *
     * @param states for one of which to wait; none for any
     * @param timeout longest time to wait, in seconds
     */
    @GET
    @Path("{replay}")
    public CompletionStage<Response> get(
            @PathParam(REPLAY) String replay,
            @QueryParam("wait") List<String> states,
            @QueryParam("timeout") @DefaultValue("30") int timeout) {
        return waits.one(() -> replays.get(replay), states, timeout, UnaryOperator.identity());
    }

    @DELETE
    @Path("{replay}")
    public CompletionStage<Response> stop(@Context ContainerRequestContext request, @PathParam(REPLAY) String replay) {
        return stop(request, none().put(REPLAY, replay));
    }

    /**
     * @param command {@code seek} has the member {@code to}, {@code speed} {@code speed}, {@code step} {@code count},
     *     {@code loop} {@code from} and {@code to}
     */
    @POST
    @Path("{replay}" + COMMANDS)
    public CompletionStage<Response> steer(
            @Context ContainerRequestContext request,
            @PathParam(REPLAY) String replay,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return manager.command(request, command, read(command, body).put(REPLAY, replay));
    }

    @GET
    @Path("groups/{group}")
    public Response group(@PathParam(GROUP) String group) {
        return JsonResponses.ok(replays.group(group).stream());
    }

    @DELETE
    @Path("groups/{group}")
    public CompletionStage<Response> stopGroup(
            @Context ContainerRequestContext request, @PathParam(GROUP) String group) {
        return stop(request, none().put(GROUP, group));
    }

    private CompletionStage<Response> stop(ContainerRequestContext request, ObjectNode members) {
        return manager.request(request, "stop", members).thenApply(answer -> JsonResponses.of(answer.after("stop")));
    }

    /** @param command as for a single replay, except {@code step} */
    @POST
    @Path("groups/{group}" + COMMANDS)
    public CompletionStage<Response> steerGroup(
            @Context ContainerRequestContext request,
            @PathParam(GROUP) String group,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return manager.command(request, command, read(command, body).put(GROUP, group));
    }

    private static ObjectNode read(String command, InputStream body) throws IOException {
        List<String> others = new ArrayList<>(List.of("to", "from", "speed", "count"));
        others.removeAll(
                switch (command) {
                    case "seek" -> List.of("to");
                    case "loop" -> List.of("from", "to");
                    case "speed" -> List.of("speed");
                    case "step" -> List.of("count");
                    default -> List.of();
                });
        return JsonBodyReader.read(body, command, others);
    }

    private static ObjectNode none() {
        return NgsiJson.object();
    }
}
