package io.furrow.control.rest;

import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.Properties;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.DefaultValue;
import jakarta.ws.rs.GET;
import jakarta.ws.rs.Path;
import jakarta.ws.rs.PathParam;
import jakarta.ws.rs.Produces;
import jakarta.ws.rs.QueryParam;
import jakarta.ws.rs.core.Context;
import jakarta.ws.rs.core.MediaType;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.core.UriInfo;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.control.letter.RecordPositions;
import io.furrow.control.letter.RecordReader;
import io.furrow.control.letter.StoredRecord;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.view.KafkaReads;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.TopicRules;
import io.furrow.model.topic.Topics;

/** {@code /api/topics}: the topics and their records, the newest first. Dead letters are at {@code /api/dead-letters}. */
@Path("/api/topics")
@Produces(MediaType.APPLICATION_JSON)
public final class TopicsResource {
    /** Members that only dead letters have. */
    private static final List<String> OF_DEAD_LETTERS = List.of("reason", "stage", "message", "source");

    private final RecordReader reader;
    private final KafkaReads reads;

    /** @param client settings of a Kafka client */
    TopicsResource(Properties client, KafkaReads reads) {
        this.reader = new RecordReader(client);
        this.reads = reads;
    }

    /** Lists the topics that may be read, and those of dead letters. */
    @GET
    public Response list() {
        return JsonResponses.ok(reads
                .run(() -> reader.topics(topic -> TopicRules.DEFAULT.mayRead(topic)
                        || Topics.ofDeadLetters(topic).isPresent()))
                .stream()
                .map(topic -> NgsiJson.object()
                        .put("topic", topic.name())
                        .put("partitions", topic.partitions())
                        .put("records", topic.records())));
    }

    /**
     * Lists records.
     *
     * @param whole whether with headers and values
     * @param key selects records with it; null for all
     * @param text selects records whose values contain it; null for all
     */
    @GET
    @Path("{topic}/records")
    public Response records(
            @Context UriInfo uri,
            @PathParam("topic") String topic,
            @QueryParam("limit") @DefaultValue("50") int limit,
            @QueryParam("values") boolean whole,
            @QueryParam("before") String before,
            @QueryParam("key") String key,
            @QueryParam("text") String text) {
        checkTopic(topic);
        RecordPositions positions = RecordPages.positions(before);
        RecordReader.Query query = RecordPages.query(uri, desired(key, text), limit, whole);
        return RecordPages.answer(uri, reads.run(() -> reader.read(topic, positions, query)), TopicsResource::json);
    }

    private static Predicate<ConsumerRecord<byte[], byte[]>> desired(String key, String text) {
        return record -> contains(record.key(), key, true) && contains(record.value(), text, false);
    }

    private static boolean contains(byte[] bytes, String text, boolean whole) {
        if (text == null || bytes == null) {
            return text == null;
        }
        String all = new String(bytes, StandardCharsets.UTF_8);
        return whole ? all.equals(text) : all.contains(text);
    }

    /** Returns a record with its headers and value. */
    @GET
    @Path("{topic}/records/{partition}/{offset}")
    public Response show(@Context UriInfo uri, @PathParam("topic") String topic) {
        checkTopic(topic);
        return JsonResponses.ok(withoutFailure(RecordPages.one(uri, reads, reader, "record")));
    }

    private static ObjectNode json(StoredRecord record) {
        return withoutFailure(record.json());
    }

    private static ObjectNode withoutFailure(ObjectNode record) {
        return record.without(OF_DEAD_LETTERS);
    }

    private static void checkTopic(String topic) {
        if (!TopicRules.DEFAULT.mayRead(topic)) {
            throw new ProblemException(
                    404,
                    "unknown-topic",
                    "'%s' is no topic that can be read here; data.* and service.* are, and dead letters at /api/dead-letters"
                            .formatted(topic));
        }
    }
}
