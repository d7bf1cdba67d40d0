package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.time.DateTimeException;
import java.time.Instant;
import java.util.UUID;
import java.util.concurrent.CompletionException;
import java.util.concurrent.CompletionStage;

import com.fasterxml.jackson.databind.JsonNode;
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

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.MarkerStore;
import io.furrow.mission.RecordingException;
import io.furrow.mission.marker.Marker;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.marker.RejectedMarkerException;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** {@code /api/missions/{mission}/markers}: notes at moments of a recorded mission, stored with its recording. */
@Path("/api/missions/{mission}/markers")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class MarkersResource {
    private static final String MISSION = "mission";
    private static final String MARKER = "marker";
    private static final String TIME = "time";
    private static final String NOTE = "note";

    private final MarkerStore store;
    private final CommandClient managers;

    MarkersResource(MarkerStore store, CommandClient managers) {
        this.store = store;
        this.managers = managers;
    }

    /** Lists markers in the order of their times. */
    @GET
    public CompletionStage<Response> list(@PathParam(MISSION) String mission) {
        return store.request(markers -> markers.list(mission))
                .thenApply(all -> JsonResponses.ok(all.stream().map(Marker::toJson)));
    }

    /** Adds a marker; a repeated {@link RequestContext#KEY} yields the same marker. */
    @POST
    public CompletionStage<Response> add(
            @Context ContainerRequestContext request, @PathParam(MISSION) String mission, InputStream body)
            throws IOException {
        ObjectNode members = JsonBodyReader.read(body);
        RequestContext caller = RequestContext.of(request);
        String id = UUID.nameUUIDFromBytes(
                        (mission + "\n" + caller.user() + "\n" + caller.requestId()).getBytes(StandardCharsets.UTF_8))
                .toString();
        Marker marker =
                new Marker(id, mission, time(members), note(members), caller.user(), System.currentTimeMillis());
        Change change = new Change(caller, "add-marker", mission, id);
        return store.request(markers -> added(markers, marker)).handle((added, failure) -> {
            audit(change, "created", failure);
            return JsonResponses.json(201, added.toJson())
                    .location(JsonResponses.location(request, "markers", id))
                    .build();
        });
    }

    /** Returns the existing marker for a repeated request. */
    private static Marker added(Markers markers, Marker marker) throws RejectedMarkerException, RecordingException {
        for (Marker each : markers.list(marker.mission(), marker.time(), marker.time() + 1)) {
            if (each.id().equals(marker.id()) && each.note().equals(marker.note())) {
                return each;
            }
        }
        markers.add(marker);
        return marker;
    }

    @DELETE
    @Path("{marker}")
    public CompletionStage<Response> remove(
            @Context ContainerRequestContext request,
            @PathParam(MISSION) String mission,
            @PathParam(MARKER) String id) {
        Change change = new Change(RequestContext.of(request), "remove-marker", mission, id);
        return store.request(markers -> {
                    if (!markers.remove(mission, id)) {
                        throw new ProblemException(
                                404, "unknown-marker", "mission '%s' has no marker '%s'".formatted(mission, id));
                    }
                    return id;
                })
                .handle((removed, failure) -> {
                    audit(change, "deleted", failure);
                    return JsonResponses.ok(CommandResult.of("deleted")
                            .with(MISSION, mission)
                            .with(MARKER, id)
                            .json());
                });
    }

    private record Change(RequestContext caller, String command, String mission, String marker) {}

    /** Audits a change and throws its failure. @param failure null if there is none */
    private void audit(Change change, String result, Throwable failure) {
        Throwable cause = FailureText.unwrap(failure);
        ObjectNode about = NgsiJson.object().put(MISSION, change.mission()).put(MARKER, change.marker());
        managers.audit(change.caller(), MARKER, change.command(), about, result, cause);
        if (failure != null) {
            throw cause instanceof ProblemException problem ? problem : new CompletionException(cause);
        }
    }

    private static long time(ObjectNode members) {
        JsonNode time = members.path(TIME);
        if (time.isIntegralNumber() && time.canConvertToLong()) {
            return time.longValue();
        }
        try {
            return Instant.parse(time.asText("")).toEpochMilli();
        } catch (DateTimeException | ArithmeticException e) {
            throw new ProblemException(
                    members.hasNonNull(TIME) ? ErrorCode.WRONG_MEMBER : ErrorCode.MISSING_MEMBER,
                    "'time' must be the event time of the moment, such as 2026-03-01T08:00:00Z, or epoch ms");
        }
    }

    private static String note(ObjectNode members) {
        if (!members.path(NOTE).isTextual()) {
            throw new ProblemException(
                    members.hasNonNull(NOTE) ? ErrorCode.WRONG_MEMBER : ErrorCode.MISSING_MEMBER,
                    "'note' must be a text of at most 1000 characters");
        }
        return members.path(NOTE).textValue();
    }
}
