package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.Comparator;
import java.util.List;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.Consumes;
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

import io.furrow.control.alarm.Severity;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.text.Coded;
import io.furrow.model.topic.Topics;

/** {@code /api/alarms}. */
@Path("/api/alarms")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class AlarmsResource {
    private static final Comparator<ObjectNode> MOST_SEVERE_FIRST = Comparator.<ObjectNode>comparingInt(
                    AlarmsResource::severity)
            .thenComparing(alarm -> alarm.path("raised").asLong(), Comparator.reverseOrder());

    private final StateView view;
    private final Manager manager;

    AlarmsResource(StateView view, CommandClient managers) {
        this.view = view;
        this.manager = new Manager(managers, Topics.ALARM_MANAGER);
    }

    /**
     * Lists alarms, the most severe first, the newest of these first.
     *
     * @param state null for all
     */
    @GET
    public Response list(@QueryParam("state") String state) {
        return JsonResponses.ok(view.all(Topics.ALARMS)
                .filter(alarm ->
                        state == null || state.equals(alarm.path("state").textValue()))
                .sorted(MOST_SEVERE_FIRST));
    }

    private static int severity(JsonNode alarm) {
        return Coded.find(Severity.values(), alarm.path("severity").asText())
                .map(Severity::ordinal)
                .orElse(Severity.values().length);
    }

    /** Changes an alarm. @param command {@code mute} needs a duration {@code for} */
    @POST
    @Path("{alarm}/{command: acknowledge|close|mute|unmute}")
    public CompletionStage<Response> command(
            @Context ContainerRequestContext request,
            @PathParam("alarm") String alarm,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return manager.command(request, command, read(command, body).put("alarm", alarm));
    }

    /** Mutes alarms by {@code kind} and {@code subject}, including future ones. */
    @POST
    @Path("{command: mute|unmute}")
    public CompletionStage<Response> commandKind(
            @Context ContainerRequestContext request, @PathParam("command") String command, InputStream body)
            throws IOException {
        return manager.command(request, command, read(command, body));
    }

    private static ObjectNode read(String command, InputStream body) throws IOException {
        return JsonBodyReader.read(body, command, command.equals("mute") ? List.of() : List.of("for"));
    }
}
