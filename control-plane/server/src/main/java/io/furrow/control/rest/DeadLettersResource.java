package io.furrow.control.rest;

import java.io.IOException;
import java.io.InputStream;
import java.util.List;
import java.util.Properties;
import java.util.Set;
import java.util.concurrent.Semaphore;
import java.util.function.Predicate;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.annotation.security.RolesAllowed;
import jakarta.ws.rs.Consumes;
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
import jakarta.ws.rs.core.UriInfo;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.control.letter.RecordPositions;
import io.furrow.control.letter.RecordReader;
import io.furrow.control.letter.Redrive;
import io.furrow.control.letter.StoredRecord;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.access.RequestContext;
import io.furrow.control.rest.view.CommandClient;
import io.furrow.control.rest.view.KafkaReads;
import io.furrow.model.control.CommandResult;
import io.furrow.model.control.JsonObjectReader;
import io.furrow.model.control.RejectedException;
import io.furrow.model.control.Role;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/**
 * {@code /api/dead-letters}: records that could not be processed. They contain whatever was sent to Furrow, as it was, so that
 * reading them needs more than the role viewer.
 */
@Path("/api/dead-letters")
@Consumes(MediaType.APPLICATION_JSON)
@Produces(MediaType.APPLICATION_JSON)
public final class DeadLettersResource {
    /** What the names of the topics begin with that may be named as the target. */
    private static final List<String> TARGETS = List.of("data.", "ngsi.");

    private static final Pattern CODE = Pattern.compile("[^\\p{Cntrl}]{1,100}");

    private final Properties client;
    private final CommandClient managers;
    private final RecordReader reader;
    private final KafkaReads reads;
    private final Semaphore redrivePermit = new Semaphore(1);

    /** @param client settings of a Kafka client */
    DeadLettersResource(Properties client, CommandClient managers, KafkaReads reads) {
        this.client = client;
        this.managers = managers;
        this.reader = new RecordReader(client);
        this.reads = reads;
    }

    /**
     * Lists letters without their values, the newest first. If there may be older ones, a {@code Link} with {@code rel="next"}
     * refers to them.
     */
    @RolesAllowed(Role.OPERATORS)
    @GET
    public Response list(
            @Context UriInfo uri,
            @QueryParam("limit") @DefaultValue("50") int limit,
            @QueryParam("before") String before,
            @QueryParam("topic") String topic) {
        RecordPositions positions = RecordPages.positions(before);
        checkTopic(topic);
        RecordReader.Query query = RecordPages.query(uri, desired(uri), limit, false);
        return RecordPages.answer(uri, reads.run(() -> reader.read(topic, positions, query)), StoredRecord::json);
    }

    private static Predicate<ConsumerRecord<byte[], byte[]>> desired(UriInfo uri) {
        String reason = uri.getQueryParameters().getFirst("reason");
        String stage = uri.getQueryParameters().getFirst("stage");
        return record -> {
            StoredRecord letter = StoredRecord.of(record, false);
            return (reason == null || reason.equals(letter.reason()))
                    && (stage == null || stage.equals(letter.stage()));
        };
    }

    /** Returns a letter with its headers and value. */
    @RolesAllowed(Role.OPERATORS)
    @GET
    @Path("{topic}/{partition}/{offset}")
    public Response show(@Context UriInfo uri, @PathParam("topic") String topic) {
        checkTopic(topic);
        return JsonResponses.ok(RecordPages.one(uri, reads, reader, "dead letter"));
    }

    private static void checkTopic(String topic) {
        if (topic != null && Topics.ofDeadLetters(topic).isEmpty()) {
            throw new ProblemException(
                    404,
                    "unknown-topic",
                    "'%s' is no topic of dead letters; those of a topic are on '%s'"
                            .formatted(topic, Topics.dead("<topic>")));
        }
    }

    /**
     * Sends letters to the topic to which they belong, or to another, each once. A request takes a limited time; the answer says
     * whether it has seen all letters.
     *
     * @param body {@code topic} of dead letters; {@code to}, {@code reasons}, {@code stages}, {@code again}
     */
    @POST
    @Path("redrive")
    public Response redrive(
            @Context ContainerRequestContext request,
            @QueryParam(CommandResult.DRY_RUN) boolean dryRun,
            InputStream body)
            throws IOException {
        RequestContext caller = RequestContext.of(request);
        ObjectNode members = JsonBodyReader.read(body);
        ObjectNode about = NgsiJson.object();
        try {
            Redrive.Request desired = request(members, dryRun);
            about.setAll(members);
            ObjectNode answer = answer(desired, redrive(desired));
            audit(caller, about.put("count", answer.path("count").asLong()), dryRun ? "dry-run" : "redriven", null);
            return JsonResponses.ok(answer);
        } catch (ProblemException problem) {
            audit(caller, about, CommandResult.ERROR, problem);
            throw problem;
        }
    }

    private static Redrive.Request request(ObjectNode members, boolean dryRun) {
        JsonObjectReader reader = new JsonObjectReader(members);
        try {
            JsonObjectReader.checkReadable(members);
            String topic = reader.text("topic");
            checkTopic(topic);
            Redrive.Request request = new Redrive.Request(
                    topic,
                    reader.textOrNull("to"),
                    new Redrive.Choice(
                            Set.copyOf(reader.texts("reasons", CODE, "codes such as not-json")),
                            Set.copyOf(reader.texts("stages", CODE, "names such as ingest"))),
                    reader.flag("again"),
                    dryRun);
            checkTarget(request);
            return request;
        } catch (RejectedException e) {
            throw new ProblemException(e.code(), e.getMessage());
        }
    }

    /**
     * Anyone can send a notification that becomes a letter: on another topic it could be a request of an administrator,
     * or a setting of Kafka Connect.
     */
    private static void checkTarget(Redrive.Request request) {
        boolean isOrigin = Topics.ofDeadLetters(request.from()).orElseThrow().equals(request.target());
        if (!isOrigin && TARGETS.stream().noneMatch(request.target()::startsWith)) {
            throw new ProblemException(
                    403,
                    "topic-not-allowed",
                    "letters are not sent to '%s'; name a topic that begins with data. or ngsi."
                            .formatted(request.target()));
        }
    }

    private Redrive.Outcome redrive(Redrive.Request desired) {
        if (!redrivePermit.tryAcquire()) {
            throw new ProblemException(
                    409, "redrive-running", "another redrive is running; ask again when it has ended, in some seconds");
        }
        try {
            return KafkaReads.unlimited(() -> new Redrive(client, desired).run());
        } finally {
            redrivePermit.release();
        }
    }

    private static ObjectNode answer(Redrive.Request request, Redrive.Outcome outcome) {
        ObjectNode answer = CommandResult.of("redriven")
                .with("topic", request.from())
                .with("to", request.target())
                .with("count", outcome.total())
                .json();
        ObjectNode reasons = answer.putObject("reasons");
        outcome.sent().forEach(reasons::put);
        ArrayNode left = answer.putArray("left");
        outcome.left()
                .forEach((why, count) -> left.addObject().put("count", count).put("why", why));
        answer.put("complete", outcome.isComplete());
        return request.dryRun() ? answer.put(CommandResult.DRY_RUN, true) : answer;
    }

    /** @param problem null if there is none */
    private void audit(RequestContext caller, ObjectNode about, String result, ProblemException problem) {
        managers.audit(caller, "dead-letters", "redrive", about, result, problem);
    }
}
