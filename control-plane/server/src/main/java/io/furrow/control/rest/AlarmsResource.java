package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.Arrays;
import java.util.Comparator;
import java.util.List;
import java.util.concurrent.CompletionStage;
import java.util.stream.Collectors;

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

import io.furrow.control.alarm.AlarmState;
import io.furrow.control.alarm.Severity;
import io.furrow.control.rest.access.ProblemException;
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
    private static final int DEFAULT_LIMIT = 1000;
    private static final int MAX_LIMIT = 10_000;
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
     * @param states at most one; none for all
     * @param limits at most one, 1 to {@value #MAX_LIMIT}
     */
    @GET
    public Response list(@QueryParam("state") List<String> states, @QueryParam("limit") List<String> limits) {
        AlarmState state = state(states);
        return JsonResponses.ok(view.all(Topics.ALARMS)
                .filter(alarm ->
                        state == null || state.code().equals(alarm.path("state").textValue()))
                .sorted(MOST_SEVERE_FIRST)
                .limit(limit(limits)));
    }

    private static AlarmState state(List<String> requested) {
        if (requested.isEmpty()) {
            return null;
        }
        String states = Arrays.stream(AlarmState.values()).map(AlarmState::code).collect(Collectors.joining(", "));
        return Coded.find(AlarmState.values(), requested.size() == 1 ? requested.get(0) : null)
                .orElseThrow(() -> new ProblemException(
                        ErrorCode.WRONG_MEMBER, "'state' must be one of " + states + ", and given once"));
    }

    private static int limit(List<String> requested) {
        String limit = requested.isEmpty() ? Integer.toString(DEFAULT_LIMIT) : requested.get(0);
        if (requested.size() > 1 || !limit.matches("[1-9][0-9]{0,4}") || Integer.parseInt(limit) > MAX_LIMIT) {
            throw new ProblemException(
                    ErrorCode.WRONG_MEMBER,
                    "'limit' must be a whole number from 1 to %d, and given once".formatted(MAX_LIMIT));
        }
        return Integer.parseInt(limit);
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
        return manager.command(request, command, JsonBodyReader.read(body).put("alarm", alarm));
    }

    /** Mutes alarms by {@code kind} and {@code subject}, including future ones. */
    @POST
    @Path("{command: mute|unmute}")
    public CompletionStage<Response> commandKind(
            @Context ContainerRequestContext request, @PathParam("command") String command, InputStream body)
            throws IOException {
        return manager.command(request, command, JsonBodyReader.read(body));
    }
}
