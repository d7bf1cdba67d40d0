package io.furrow.control.rest;

import java.time.Instant;
import java.util.List;
import java.util.Set;
import java.util.concurrent.CompletionException;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.DELETE;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.EventTiles;
import io.furrow.control.rest.view.MarkerStore;
import io.furrow.control.rest.view.MissionTimeline;
import io.furrow.control.rest.view.ReplayStatusView;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.TopicName;
import io.furrow.model.topic.Topics;

/** {@code /api/recordings}: recorded missions, the distribution of their events over time, and their deletion. */
@Path("/api/recordings")
@Produces(MediaType.APPLICATION_JSON)
public final class RecordingsResource {
    private static final String MISSION = "mission";
    private static final int BUCKETS = 240;
    private static final String PURGED = "purged";
    /** States of missions with devices. */
    private static final Set<String> ACTIVE = Set.of("starting", "running", "stopping");
    /** States of replays that play no more. */
    private static final Set<String> OVER = Set.of("ended", "stopped", "failed");

    private final StateView view;
    private final ReplayStatusView replays;
    private final EventTiles events;
    private final MarkerStore store;
    private final CommandClient managers;
    private final Executor executor;

    /** @param events null if there is no MongoDB @param executor creates the answers */
    RecordingsResource(
            StateView view, EventTiles events, MarkerStore store, CommandClient managers, Executor executor) {
        this.view = view;
        this.replays = new ReplayStatusView(view);
        this.events = events;
        this.store = store;
        this.managers = managers;
        this.executor = executor;
    }

    @GET
    public Response list() {
        return JsonResponses.ok(view.all(Topics.RECORDINGS));
    }

    /**
     * Returns the number of events of a mission per bucket, by default over the whole mission.
     *
     * @param froms at most one, ISO 8601 or epoch ms; {@code tos} likewise, exclusive
     * @param buckets at most one: the maximum number of buckets
     */
    @GET
    @Path("{mission}/timeline")
    public CompletionStage<Response> timeline(
            @PathParam(MISSION) String mission,
            @QueryParam("from") List<String> froms,
            @QueryParam("to") List<String> tos,
            @QueryParam("buckets") List<String> buckets) {
        if (events == null) {
            throw ProblemException.noMongo();
        }
        MissionTimeline.Extent extent = extent(mission);
        long from = ParameterValues.time("from", froms, extent.first());
        long to = ParameterValues.time("to", tos, extent.last() + 1);
        if (from >= to || from > extent.last() || to <= extent.first()) {
            throw new ProblemException(
                    ErrorCode.WRONG_MEMBER,
                    "'from' must be before 'to', and the mission's events lie between %s and %s"
                            .formatted(Instant.ofEpochMilli(extent.first()), Instant.ofEpochMilli(extent.last())));
        }
        return MissionTimeline.of(mission, extent, from, to, number(buckets))
                .count(events, executor)
                .thenApply(JsonResponses::ok);
    }

    /** Deletes the events and markers of a mission, unless it is running or replayed. */
    @RolesAllowed(Role.ADMINS)
    @DELETE
    @Path("{mission}")
    public CompletionStage<Response> purge(
            @Context ContainerRequestContext request,
            @PathParam(MISSION) String mission,
            @QueryParam(CommandResult.DRY_RUN) boolean dryRun) {
        RequestContext caller = RequestContext.of(request);
        ObjectNode about = NgsiJson.object().put(MISSION, mission);
        return store.purge(mission, dryRun, () -> checkUnused(mission)).handle((purge, failure) -> {
            Throwable cause = FailureText.unwrap(failure);
            if (cause == null) {
                about.put("events", purge.events()).put("markers", purge.markers());
            }
            managers.audit(caller, "recordings", "purge", about, dryRun ? "dry-run" : PURGED, cause);
            if (cause != null) {
                throw cause instanceof ProblemException problem ? problem : new CompletionException(cause);
            }
            if (!dryRun) {
                events.forget();
            }
            ObjectNode answer = CommandResult.of(PURGED).json();
            answer.setAll(about);
            return JsonResponses.ok(dryRun ? answer.put(CommandResult.DRY_RUN, true) : answer);
        });
    }

    private void checkUnused(String mission) {
        boolean isActive = view.all(Topics.MISSIONS_STATUS)
                .anyMatch(status -> isOf(mission, status)
                        && ACTIVE.contains(status.path("state").asText()));
        ProblemException.rejectIf(
                isActive, ErrorCode.MISSION_RUNNING, "mission '%s' is running; stop it first".formatted(mission));
        replays.all()
                .filter(replay -> isOf(mission, replay)
                        && !OVER.contains(replay.at("/status/state").asText()))
                .findFirst()
                .ifPresent(replay -> {
                    throw new ProblemException(
                            409,
                            "replay-running",
                            "replay '%s' plays mission '%s'; stop it first"
                                    .formatted(replay.path("replay").asText(), mission));
                });
    }

    private static boolean isOf(String mission, ObjectNode resource) {
        String other = resource.path(MISSION).asText();
        return mission.equals(other)
                || mission.equals(TopicName.of(other))
                || TopicName.of(mission).equals(other);
    }

    private MissionTimeline.Extent extent(String mission) {
        ObjectNode recording = view.find(Topics.RECORDINGS, mission)
                .or(() -> view.find(Topics.RECORDINGS, TopicName.of(mission)))
                .orElseThrow(() -> EventTiles.unknown(mission));
        return new MissionTimeline.Extent(
                recording.path("first").asLong(), recording.path("last").asLong());
    }

    private static int number(List<String> values) {
        try {
            int number = values.isEmpty() ? BUCKETS : Integer.parseInt(values.get(0));
            if (values.size() < 2 && number >= 1 && number <= MissionTimeline.MAX_BUCKETS) {
                return number;
            }
        } catch (NumberFormatException e) {
            // rejected below
        }
        throw new ProblemException(
                ErrorCode.WRONG_MEMBER, "'buckets' must be a number from 1 to " + MissionTimeline.MAX_BUCKETS);
    }
}
