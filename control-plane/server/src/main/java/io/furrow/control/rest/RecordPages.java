package io.furrow.control.rest;

import java.util.List;
import java.util.Optional;
import java.util.function.Function;
import java.util.function.Predicate;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import jakarta.ws.rs.core.Response;
import jakarta.ws.rs.core.UriInfo;
import org.apache.kafka.clients.consumer.ConsumerRecord;

import io.furrow.control.letter.RecordPositions;
import io.furrow.control.letter.RecordReader;
import io.furrow.control.letter.StoredRecord;
import io.furrow.control.rest.access.ProblemException;
import io.furrow.control.rest.description.ParameterValues;
import io.furrow.control.rest.view.KafkaReads;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.ngsi.NgsiJson;

/** Translates requests for records of topics, and answers them. */
final class RecordPages {
    private static final Pattern NUMBER = Pattern.compile("[0-9]{1,9}");
    private static final Pattern LONG_NUMBER = Pattern.compile("[0-9]{1,18}");

    private RecordPages() {}

    /** @param before of the request; null if it has none */
    static RecordPositions positions(String before) {
        return before == null
                ? null
                : RecordPositions.of(before)
                        .orElseThrow(() -> new ProblemException(
                                ErrorCode.WRONG_MEMBER,
                                "'before' must be that of the Link of the previous page; without it the newest come"));
    }

    static RecordReader.Query query(
            UriInfo uri, Predicate<ConsumerRecord<byte[], byte[]>> desired, int limit, boolean whole) {
        var query = uri.getQueryParameters();
        long from = ParameterValues.time("from", query.getOrDefault("from", List.of()), Long.MIN_VALUE);
        long to = ParameterValues.time("to", query.getOrDefault("to", List.of()), Long.MAX_VALUE);
        return new RecordReader.Query(desired, from, to, limit, whole);
    }

    /** Returns the records; if there may be older ones, a {@code Link} with {@code rel="next"} refers to them. */
    static Response answer(UriInfo uri, RecordReader.Page page, Function<StoredRecord, ObjectNode> json) {
        ArrayNode records = NgsiJson.array();
        page.records().forEach(record -> records.add(json.apply(record)));
        Response.ResponseBuilder answer = JsonResponses.json(200, records);
        if (!page.next().isEmpty()) {
            answer.header("Link", AuditResource.next(uri, page.next()));
        }
        return answer.build();
    }

    /**
     * Returns the record that the path names, with its headers and value.
     *
     * @param kind what it is called
     * @throws ProblemException 404 if there is none, or partition and offset are no numbers
     */
    static ObjectNode one(UriInfo uri, KafkaReads reads, RecordReader reader, String kind) {
        String topic = uri.getPathParameters().getFirst("topic");
        String partition = uri.getPathParameters().getFirst("partition");
        String offset = uri.getPathParameters().getFirst("offset");
        boolean isPlace = NUMBER.matcher(partition).matches()
                && LONG_NUMBER.matcher(offset).matches();
        Optional<ObjectNode> record = isPlace
                ? reads.run(() -> reader.find(topic, Integer.parseInt(partition), Long.parseLong(offset)))
                : Optional.empty();
        return record.orElseThrow(() -> new ProblemException(
                404,
                "unknown-" + kind.replace(' ', '-'),
                "'%s' has no %s at partition '%s' and offset '%s', or has it no longer"
                        .formatted(topic, kind, partition, offset)));
    }
}
