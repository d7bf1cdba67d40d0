package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.function.Predicate;

import com.mongodb.client.FindIterable;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Sorts;
import org.bson.BsonDateTime;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;

import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingInterruptedException;
import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Counts the matching events of a mission backwards. Queries sort by event time only, newest first; a millisecond that
 * the limit truncates is read again by its time. Holds the ids of one millisecond, and no documents.
 */
final class ReverseEventCounter {
    private static final int MAX_BATCH = 500;

    private final MongoCollection<RawBsonDocument> collection;
    private final Cursor first;
    private final Predicate<StoredEvent> desired;
    private final OrderedDocumentReader.Sizes sizes;
    private final List<Counted> millisecond = new ArrayList<>();
    private long remaining;

    /** A document of the current millisecond. */
    private record Counted(Cursor cursor, boolean isDesired) {
        static final Comparator<Counted> NEWEST_FIRST =
                Comparator.comparing(Counted::cursor).reversed();
    }

    /** @param first documents up to this cursor are not read */
    ReverseEventCounter(
            MongoCollection<RawBsonDocument> collection,
            Cursor first,
            Predicate<StoredEvent> desired,
            OrderedDocumentReader.Sizes sizes) {
        this.collection = collection;
        this.first = first;
        this.desired = desired;
        this.sizes = sizes;
    }

    /**
     * Returns the position that lies {@code count} matching events before another; the first one if there are fewer.
     */
    Cursor cursor(Cursor from, long count) throws RecordingInterruptedException {
        remaining = count;
        Bson until = Filters.lte(EventDocumentCodec.TIME, new BsonDateTime(from.time()));
        while (true) {
            RecordingInterruptedException.check();
            Query query = new Query(from);
            Optional<Cursor> found = query.read(until);
            if (found.isPresent() || query.fetched < sizes.firstLimit()) {
                return found.or(this::position).orElse(first);
            }
            long truncatedTime = query.time;
            found = readMillisecond(truncatedTime, from);
            if (found.isPresent()) {
                return found.get();
            }
            until = Filters.lt(EventDocumentCodec.TIME, new BsonDateTime(truncatedTime));
        }
    }

    /** A query for the newest documents until a time. */
    private final class Query {
        private final Cursor from;
        private int fetched;
        private long time;

        Query(Cursor from) {
            this.from = from;
        }

        /** Reads and counts the documents, except those of the oldest millisecond. */
        Optional<Cursor> read(Bson until) throws RecordingInterruptedException {
            FindIterable<RawBsonDocument> newest = collection
                    .find(Filters.and(
                            OrderedDocumentReader.NOT_ARRAY,
                            Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(first.time())),
                            until))
                    .sort(Sorts.descending(EventDocumentCodec.TIME))
                    .limit(sizes.firstLimit())
                    .batchSize((int) Math.min(remaining + 2, MAX_BATCH));
            try (MongoCursor<RawBsonDocument> documents = newest.cursor()) {
                while (documents.hasNext()) {
                    RecordingInterruptedException.check();
                    OrderedDocumentReader.Ordered next = OrderedDocumentReader.Ordered.of(documents.next());
                    if (fetched++ > 0 && next.time() != time) {
                        Optional<Cursor> found = position();
                        if (found.isPresent()) {
                            return found;
                        }
                    }
                    time = next.time();
                    add(next, from);
                }
            }
            return Optional.empty();
        }
    }

    private Optional<Cursor> readMillisecond(long time, Cursor from) throws RecordingInterruptedException {
        millisecond.clear();
        try (MongoCursor<RawBsonDocument> documents = collection
                .find(Filters.and(
                        OrderedDocumentReader.NOT_ARRAY, Filters.eq(EventDocumentCodec.TIME, new BsonDateTime(time))))
                .batchSize(MAX_BATCH)
                .cursor()) {
            while (documents.hasNext()) {
                RecordingInterruptedException.check();
                add(OrderedDocumentReader.Ordered.of(documents.next()), from);
            }
        }
        return position();
    }

    private void add(OrderedDocumentReader.Ordered document, Cursor from) {
        Cursor cursor = document.cursor();
        if (cursor.compareTo(from) <= 0 && cursor.compareTo(first) > 0) {
            millisecond.add(new Counted(cursor, isDesired(document)));
        }
    }

    private boolean isDesired(OrderedDocumentReader.Ordered document) {
        try {
            return desired.test(document.event());
        } catch (UnreadableException e) {
            return false; // reported with its page
        }
    }

    /** Counts the millisecond and returns the position if it lies there. */
    private Optional<Cursor> position() {
        millisecond.sort(Counted.NEWEST_FIRST);
        for (Counted document : millisecond) {
            if (remaining == 0 && document.isDesired()) {
                return Optional.of(document.cursor());
            }
            remaining -= remaining > 0 && document.isDesired() ? 1 : 0;
        }
        millisecond.clear();
        return Optional.empty();
    }
}
