package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.concurrent.CompletionStage;

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

import io.furrow.model.topic.Topics;

/** {@code /api/alarms}. */
@Path("/api/alarms")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class AlarmsResource {
    private final ServiceView view;
    private final Managers managers;

    AlarmsResource(ServiceView view, Managers managers) {
        this.view = view;
        this.managers = managers;
    }

    /** @param state null for all */
    @GET
    public Response list(@QueryParam("state") String state) {
        return Replies.ok(view.all(Topics.ALARMS).stream()
                .filter(alarm ->
                        state == null || state.equals(alarm.path("state").textValue())));
    }

    /** @param command {@code for}, a duration, belongs to {@code mute} */
    @POST
    @Path("{alarm}/{command: acknowledge|close|mute|unmute}")
    public CompletionStage<Response> command(
            @Context ContainerRequestContext request,
            @PathParam("alarm") String alarm,
            @PathParam("command") String command,
            InputStream body)
            throws IOException {
        return ask(command, Body.read(body).put("alarm", alarm), request);
    }

    /** Alarms by {@code kind} and {@code subject}, those to come too. */
    @POST
    @Path("{command: mute|unmute}")
    public CompletionStage<Response> commandKind(
            @Context ContainerRequestContext request, @PathParam("command") String command, InputStream body)
            throws IOException {
        return ask(command, Body.read(body), request);
    }

    private CompletionStage<Response> ask(String command, ObjectNode members, ContainerRequestContext request) {
        Managers.Question question = new Managers.Question(Topics.ALARM_MANAGER, command, members);
        return managers.ask(question, Caller.of(request)).thenApply(answer -> Replies.of(answer, 200));
    }
}
