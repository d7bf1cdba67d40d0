package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.OptionalLong;
import java.util.function.Consumer;

import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Projections;
import com.mongodb.client.model.Sorts;
import org.bson.BsonBoolean;
import org.bson.BsonDateTime;
import org.bson.BsonDocument;
import org.bson.BsonNumber;
import org.bson.BsonString;
import org.bson.BsonValue;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;

import io.furrow.mission.RecordingException;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Numbers;

/**
 * Reads the values of one attribute of an entity from stored missions, the newest first, over the index on entity and
 * event time. Holds one page of values, whatever the length of the period.
 */
public final class AttributeHistory extends StoredDatabase {
    private static final int PAGE = 2_000;
    private static final String VALUE = "value";
    private static final int MAX_TEXT = 100;

    private final int page;

    AttributeHistory(MongoRecordings at, int page) {
        super(at);
        this.page = page;
    }

    /**
     * Opens the missions without waiting for the server.
     *
     * @param database {@link MongoAccess#DATABASE} unless missions were moved
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static AttributeHistory open(String uri, String database) {
        return new AttributeHistory(new MongoRecordings(uri, database), PAGE);
    }

    /**
     * An attribute in a period.
     *
     * @param entity its id, which entities of several scopes and types may share
     * @param attribute its name, any text
     * @param from epoch ms
     * @param to epoch ms, exclusive
     */
    public record Range(String entity, String attribute, long from, long to) {}

    /**
     * A value.
     *
     * @param time epoch ms
     * @param type of the entity
     * @param number a number or the number in a text as {@link Numbers} reads it, 1 for true, 0 for false; NaN for
     *     anything else
     * @param text the text, if it is no number, truncated to {@value #MAX_TEXT} characters; empty if it is none
     * @param unit metadata {@code unitCode}, else {@code unit}; empty if there is none
     */
    public record Value(
            long time, FiwareScope scope, String type, double number, boolean isBoolean, String text, String unit) {}

    /**
     * Reads the values, the newest first, until all were read or the time is over.
     *
     * @param mission its name or its encoded name in topics and collections
     * @param deadline {@link System#nanoTime()} after which no further page is read
     * @return epoch ms since which all values were read; empty if the mission is not stored
     * @throws RecordingException if MongoDB is unavailable
     */
    public OptionalLong read(String mission, Range range, long deadline, Consumer<Value> consumer)
            throws RecordingException {
        return run("The values of mission %s cannot be read from".formatted(mission), () -> {
            Optional<String> name = MongoRecordings.collectionOf(database(), mission);
            return name.isEmpty()
                    ? OptionalLong.empty()
                    : OptionalLong.of(read(
                            database().getCollection(name.get(), RawBsonDocument.class), range, deadline, consumer));
        });
    }

    private long read(
            MongoCollection<RawBsonDocument> collection, Range range, long deadline, Consumer<Value> consumer) {
        String field = FieldName.ofAttribute(range.attribute());
        Bson fields = Projections.include(
                EventDocumentCodec.TIME,
                "type",
                EventDocumentCodec.HEADERS + "." + HeaderNames.SERVICE,
                EventDocumentCodec.HEADERS + "." + HeaderNames.SERVICE_PATH,
                field);
        Bson own = Filters.and(
                Filters.eq(EventDocumentCodec.ENTITY_ID, range.entity()),
                OrderedDocumentReader.NOT_ARRAY,
                Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(range.from())));
        Bson before = Filters.lt(EventDocumentCodec.TIME, new BsonDateTime(range.to()));
        while (true) {
            List<RawBsonDocument> documents = new ArrayList<>();
            try (MongoCursor<RawBsonDocument> each = collection
                    .find(Filters.and(own, before))
                    .projection(fields)
                    .sort(Sorts.descending(EventDocumentCodec.TIME))
                    .limit(page)
                    .batchSize(page)
                    .cursor()) {
                each.forEachRemaining(documents::add);
            }
            boolean isLast = documents.size() < page;
            long oldest = isLast ? range.from() : OrderedDocumentReader.time(documents.get(page - 1));
            // further documents may have the oldest time; of more than a page of one millisecond, the others are
            // skipped
            boolean isOneMillisecond = !isLast && OrderedDocumentReader.time(documents.get(0)) == oldest;
            documents.stream()
                    .filter(document -> isLast || isOneMillisecond || OrderedDocumentReader.time(document) > oldest)
                    .forEach(document -> value(document, field).ifPresent(consumer));
            if (isLast || System.nanoTime() > deadline) {
                return isLast ? range.from() : oldest + 1;
            }
            before = isOneMillisecond
                    ? Filters.lt(EventDocumentCodec.TIME, new BsonDateTime(oldest))
                    : Filters.lte(EventDocumentCodec.TIME, new BsonDateTime(oldest));
        }
    }

    /** Returns the value; empty if the report does not have the attribute. */
    private static Optional<Value> value(RawBsonDocument document, String field) {
        if (!(document.get(field) instanceof BsonDocument attribute)) {
            return Optional.empty();
        }
        BsonValue value = attribute.get(VALUE);
        BsonValue headers = document.get(EventDocumentCodec.HEADERS);
        double number = number(value);
        String text = Double.isNaN(number) ? text(attribute, VALUE) : "";
        return Optional.of(new Value(
                OrderedDocumentReader.time(document),
                FiwareScope.of(text(headers, HeaderNames.SERVICE), text(headers, HeaderNames.SERVICE_PATH)),
                text(document, "type"),
                number,
                value instanceof BsonBoolean,
                text.length() <= MAX_TEXT ? text : text.substring(0, MAX_TEXT) + "…",
                unit(attribute)));
    }

    private static double number(BsonValue value) {
        double number = value instanceof BsonNumber own
                ? own.doubleValue()
                : value instanceof BsonBoolean flag
                        ? flag.getValue() ? 1 : 0
                        : value instanceof BsonString own ? Numbers.finite(own.getValue()) : Double.NaN;
        return Double.isFinite(number) ? number : Double.NaN;
    }

    private static String unit(BsonDocument attribute) {
        BsonValue metadata = attribute.get("metadata");
        String code = text(member(metadata, "unitCode"), VALUE);
        return code.isEmpty() ? text(member(metadata, "unit"), VALUE) : code;
    }

    private static BsonValue member(BsonValue value, String name) {
        return value instanceof BsonDocument document ? document.get(name) : null;
    }

    private static String text(BsonValue value, String name) {
        return member(value, name) instanceof BsonString text ? text.getValue() : "";
    }
}
