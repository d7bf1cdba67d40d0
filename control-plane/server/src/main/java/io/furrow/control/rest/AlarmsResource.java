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
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.text.Coded;
import io.furrow.model.topic.Topics;

/** {@code /api/alarms}. */
@Path("/api/alarms")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class AlarmsResource {
    private static final String ALARM = "alarm";
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
     * @param kind null for all
     * @param froms at most one, ISO 8601 or epoch ms: selects alarms that were not closed before; {@code tos} likewise,
     *     that were raised before
     */
    @GET
    public Response list(
            @QueryParam("state") String state,
            @QueryParam("kind") String kind,
            @QueryParam("from") List<String> froms,
            @QueryParam("to") List<String> tos) {
        long from = ParameterValues.time("from", froms, Long.MIN_VALUE);
        long to = ParameterValues.time("to", tos, Long.MAX_VALUE);
        return JsonResponses.ok(view.all(Topics.ALARMS)
                .filter(alarm -> is(alarm, "state", state) && is(alarm, "kind", kind))
                .filter(alarm -> alarm.path("raised").asLong() < to)
                .filter(alarm -> alarm.path("changed").asLong() >= from || !is(alarm, "state", "closed"))
                .sorted(MOST_SEVERE_FIRST));
    }

    private static boolean is(ObjectNode alarm, String member, String desired) {
        return desired == null || desired.equals(alarm.path(member).textValue());
    }

    @GET
    @Path("{alarm}")
    public Response get(@PathParam(ALARM) String alarm) {
        return JsonResponses.one(view.find(Topics.ALARMS, alarm)
                .orElseThrow(() -> new ProblemException(
                        ErrorCode.UNKNOWN_ALARM,
                        "there is no alarm '%s'; a closed one is kept for a day".formatted(alarm))));
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
            @PathParam(ALARM) String alarm,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return manager.command(request, command, read(command, body).put(ALARM, alarm));
    }

    /** Mutes alarms by {@code kind} and {@code subject}, including future ones. */
    @POST
    @Path("mute")
    public CompletionStage<Response> mute(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.command(request, "mute", read("mute", body));
    }

    /** Unmutes alarms by {@code kind} and {@code subject}. */
    @POST
    @Path("unmute")
    public CompletionStage<Response> unmute(@Context ContainerRequestContext request, InputStream body)
            throws IOException {
        return manager.command(request, "unmute", read("unmute", body));
    }

    private static ObjectNode read(String command, InputStream body) throws IOException {
        return JsonBodyReader.read(body, command, command.equals("mute") ? List.of() : List.of("for"));
    }
}
