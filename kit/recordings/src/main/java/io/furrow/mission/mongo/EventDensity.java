package io.furrow.mission.mongo;

import java.util.List;
import java.util.Optional;
import java.util.concurrent.TimeUnit;

import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Accumulators;
import com.mongodb.client.model.Aggregates;
import com.mongodb.client.model.Filters;
import org.bson.BsonDateTime;
import org.bson.Document;
import org.bson.conversions.Bson;

import io.furrow.mission.RecordingException;

/**
 * Counts the events of stored missions by event time. MongoDB counts with its index on event time, if there is one, and
 * returns no document.
 */
public final class EventDensity extends StoredDatabase {
    private static final int COUNT_SECONDS = 30;
    private static final String COUNT = "count";
    private static final String TIME = "$" + EventDocumentCodec.TIME;
    /** Bucket of arrays of dates, which a comparison with a date also matches. */
    private static final int NONE = -1;

    EventDensity(MongoRecordings at) {
        super(at);
    }

    /**
     * Opens the missions without waiting for the server.
     *
     * @param database {@link MongoAccess#DATABASE} unless missions were moved
     * @throws IllegalArgumentException if the URI is invalid
     */
    public static EventDensity open(String uri, String database) {
        return new EventDensity(new MongoRecordings(uri, database));
    }

    /**
     * Counts the events in each of the buckets {@code [from, from + width)}, {@code [from + width, from + 2 width)} and
     * so on; empty if the mission is not stored.
     *
     * @param mission its name or its encoded name in topics and collections
     * @param from epoch ms
     * @param width ms
     * @throws RecordingException if MongoDB is unavailable or does not answer within 30 s
     */
    public Optional<long[]> count(String mission, long from, long width, int buckets) throws RecordingException {
        if (width < 1 || buckets < 1) {
            throw new IllegalArgumentException(
                    "buckets and width must be positive: buckets=%d, widthMillis=%d".formatted(buckets, width));
        }
        return run(
                "The events of mission %s cannot be counted at".formatted(mission),
                () -> MongoRecordings.collectionOf(database(), mission)
                        .map(name -> count(database().getCollection(name), from, width, buckets)));
    }

    private static long[] count(MongoCollection<Document> collection, long from, long width, int buckets) {
        Document number = new Document(
                "$floor",
                new Document(
                        "$divide", List.of(new Document("$subtract", List.of(TIME, new BsonDateTime(from))), width)));
        Document bucket = new Document("$cond", List.of(new Document("$isArray", TIME), NONE, number));
        Bson range = Filters.and(
                Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(from)),
                Filters.lt(
                        EventDocumentCodec.TIME,
                        new BsonDateTime(Math.addExact(from, Math.multiplyExact(width, buckets)))));
        long[] counts = new long[buckets];
        collection
                .aggregate(List.of(Aggregates.match(range), Aggregates.group(bucket, Accumulators.sum(COUNT, 1))))
                .maxTime(COUNT_SECONDS, TimeUnit.SECONDS)
                .forEach(group -> {
                    int index = ((Number) group.get("_id")).intValue();
                    if (index >= 0 && index < buckets) {
                        counts[index] = ((Number) group.get(COUNT)).longValue();
                    }
                });
        return counts;
    }
}
