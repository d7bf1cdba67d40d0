package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.io.OutputStream;
import java.util.concurrent.Semaphore;

import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.MongoException;
import jakarta.servlet.http.HttpServletResponse;
import jakarta.ws.rs.Consumes;
import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.POST;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.container.AsyncResponse;
import jakarta.ws.rs.container.ContainerRequestContext;
import jakarta.ws.rs.container.Suspended;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.core.StreamingOutput;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.EventTiles;
import io.furrow.kafka.DaemonThreads;
import io.furrow.mission.Recording;
import io.furrow.mission.archive.StoredMissions;
import io.furrow.mission.export.McapExport;
import io.furrow.mission.export.MissionExport;
import io.furrow.mission.marker.Markers;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.mission.mongo.MongoRecordings;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;
import io.furrow.model.topic.TopicName;

/**
 * {@code /api/recordings/{mission}/events}: exports and imports the events of a mission as a stream. Each of at most
 * {@value #MAX_TRANSFERS} transfers has its own thread, because it may last for hours.
 */
@Path("/api/recordings/{mission}/events")
public final class RecordedEventsResource {
    static final String LINES = "application/x-ndjson";

    private static final Logger LOG = LoggerFactory.getLogger(RecordedEventsResource.class);
    private static final int MAX_TRANSFERS = 2;
    private static final String MISSION = "mission";
    private static final String MCAP = "mcap";
    /** Makes Jetty close the connection: else a client would take what it has for all. */
    private static final int ABORT = -1;

    private final String mongo;
    private final CommandClient managers;
    private final Semaphore free = new Semaphore(MAX_TRANSFERS);

    /** @param mongo URI; null if there is no MongoDB */
    RecordedEventsResource(String mongo, CommandClient managers) {
        this.mongo = mongo;
        this.managers = managers;
    }

    private interface Transfer {
        void run(StoredMissions missions) throws IOException, InterruptedException;
    }

    /** Exports all events in the order of their times. @param format {@code jsonl}, which can be imported, or {@code mcap} */
    @GET
    @Produces({LINES, MediaType.APPLICATION_OCTET_STREAM})
    public void export(
            @Context HttpServletResponse connection,
            @PathParam(MISSION) String mission,
            @QueryParam("format") @DefaultValue("jsonl") String format,
            @Suspended AsyncResponse response) {
        boolean isMcap = format.equals(MCAP);
        start(response, missions -> {
            if (!missions.has(mission)) {
                throw EventTiles.unknown(mission);
            }
            StreamingOutput events = out -> write(missions, mission, isMcap, out, connection);
            response.resume(Response.ok(events, isMcap ? MediaType.APPLICATION_OCTET_STREAM : LINES)
                    .header("Cache-Control", "no-store")
                    .header("Transfer-Encoding", "chunked") // else a connection that is not reused just ends after it
                    .build());
        });
    }

    private void write(
            StoredMissions missions, String mission, boolean isMcap, OutputStream out, HttpServletResponse connection)
            throws IOException {
        try {
            if (isMcap) {
                writeMcap(mission, out);
            } else {
                missions.export(mission, out, ignored -> {});
            }
        } catch (IOException | RuntimeException e) { // also a bug must not look like the end
            LOG.warn("the export of mission '{}' has ended early: {}", mission, FailureText.of(e), e);
            connection.sendError(ABORT);
        }
    }

    private void writeMcap(String mission, OutputStream out) throws IOException {
        try (Recording recording = new MongoRecordings(mongo, MongoAccess.DATABASE)
                        .open(mission)
                        .orElseThrow(() -> new IOException("the mission was deleted"));
                Markers markers = Markers.open(mongo, MongoAccess.DATABASE)) {
            new McapExport()
                    .write(new MissionExport.Source(mission, recording, markers.list(mission)), out, ignored -> {});
        }
    }

    /** Imports lines as an export has them; stored events are not duplicated. */
    @POST
    @Consumes({LINES, MediaType.APPLICATION_JSON})
    @Produces(MediaType.APPLICATION_JSON)
    public void importFrom(
            @Context ContainerRequestContext request,
            @PathParam(MISSION) String mission,
            InputStream body,
            @Suspended AsyncResponse response) {
        RequestContext caller = RequestContext.of(request);
        ObjectNode about = NgsiJson.object().put(MISSION, mission);
        ProblemException.rejectIf(
                !TopicName.isLegal(mission), ErrorCode.ILLEGAL_NAME, "a mission has 1 to 64 of A-Z a-z 0-9 _ -");
        start(response, missions -> {
            try {
                about.put("events", importFrom(missions, mission, body));
            } catch (RuntimeException failure) {
                managers.audit(caller, "recordings", "import", about, null, failure);
                throw failure;
            }
            managers.audit(caller, "recordings", "import", about, "imported", null);
            ObjectNode answer = CommandResult.of("imported").json();
            answer.setAll(about);
            response.resume(JsonResponses.ok(answer));
        });
    }

    private static long importFrom(StoredMissions missions, String mission, InputStream body)
            throws InterruptedException {
        try {
            return missions.importFrom(mission, body, "the body", ignored -> {});
        } catch (IOException e) {
            if (e.getCause() instanceof UnreadableException) {
                throw new ProblemException(
                        400, "not-an-event", e.getMessage() + "; events of lines before it are stored");
            }
            throw away(e);
        } catch (MongoException e) {
            throw away(e);
        }
    }

    private static ProblemException away(Exception cause) {
        return new ProblemException(
                503,
                "mongodb-away",
                "events cannot be read or stored (%s); what is stored stays, and the request can be repeated"
                        .formatted(FailureText.of(cause)));
    }

    private void start(AsyncResponse response, Transfer transfer) {
        if (mongo == null) {
            throw ProblemException.noMongo();
        }
        if (!free.tryAcquire()) {
            throw new ProblemException(
                    503, "overloaded", "%d exports or imports are running; ask again later".formatted(MAX_TRANSFERS));
        }
        DaemonThreads.named("control-plane-transfer")
                .newThread(() -> run(response, transfer))
                .start();
    }

    private void run(AsyncResponse response, Transfer transfer) {
        try (StoredMissions missions = StoredMissions.open(mongo)) {
            transfer.run(missions);
        } catch (IOException | MongoException e) {
            response.resume(away(e));
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            response.resume(away(e));
        } catch (RuntimeException e) { // also a bug must complete the answer
            response.resume(e);
        } finally {
            free.release();
        }
    }
}
