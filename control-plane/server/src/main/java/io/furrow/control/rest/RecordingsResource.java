package io.furrow.control.rest;

import java.time.Instant;
import java.util.List;
import java.util.concurrent.CompletionStage;
import java.util.concurrent.Executor;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.control.rest.view.EventTiles;
import io.furrow.control.rest.view.MissionTimeline;
import io.furrow.control.rest.view.StateView;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.topic.TopicName;
import io.furrow.model.topic.Topics;

/** {@code /api/recordings}: recorded missions and the distribution of their events over time. */
@Path("/api/recordings")
@Produces(MediaType.APPLICATION_JSON)
public final class RecordingsResource {
    private static final String MISSION = "mission";
    private static final int BUCKETS = 240;

    private final StateView view;
    private final EventTiles events;
    private final Executor executor;

    /** @param events null if there is no MongoDB @param executor creates the answers */
    RecordingsResource(StateView view, EventTiles events, Executor executor) {
        this.view = view;
        this.events = events;
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
            throw new ProblemException(
                    501, "no-mongodb", "this control plane was started without --mongo, where missions are stored");
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
