package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.Set;
import java.util.concurrent.TimeUnit;
import java.util.function.Predicate;
import java.util.function.Supplier;

import com.mongodb.MongoCommandException;
import com.mongodb.MongoException;
import com.mongodb.MongoExecutionTimeoutException;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoDatabase;
import com.mongodb.client.model.CountOptions;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Projections;
import com.mongodb.client.model.Sorts;
import org.bson.BsonDateTime;
import org.bson.BsonType;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;
import io.furrow.mission.SkippedRecords;
import io.furrow.mission.StepBack;
import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.UnreadableException;

/** Reads a mission from MongoDB. Consecutive pages share a query; any other page starts a new one by event time. */
final class MongoRecording implements Recording {
    /** Matches dates only, because MongoDB does not compare a date with a value of another type. */
    private static final Bson TIMED = Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(Long.MIN_VALUE));

    private static final Bson UNTIMED = Filters.or(
            Filters.not(Filters.type(EventDocumentCodec.TIME, BsonType.DATE_TIME)),
            Filters.type(EventDocumentCodec.TIME, BsonType.ARRAY));

    private static final Logger LOG = LoggerFactory.getLogger(MongoRecording.class);
    private static final int COUNT_SECONDS = 3;

    private final String mission;
    private final SharedMongoClient client;
    private final MongoCollection<RawBsonDocument> collection;
    private final String where;
    private final OrderedDocumentReader.Sizes sizes;
    /** The open query; null before the first page and after an error. */
    private OrderedDocumentReader documents;

    private Cursor position = Cursor.START;
    /** Number of documents without an event time; counted once, because no index helps. Null before. */
    private Long untimed;

    /** Whether the server uses indexes; null until it is asked. */
    private Boolean indexed;

    /** @param where named in messages */
    MongoRecording(
            String mission,
            SharedMongoClient client,
            MongoCollection<RawBsonDocument> collection,
            String where,
            OrderedDocumentReader.Sizes sizes) {
        this.mission = mission;
        this.client = client;
        this.collection = collection;
        this.where = where;
        this.sizes = sizes;
    }

    @Override
    public Optional<RecordingExtent> span() throws RecordingException {
        return run(() -> span(collection));
    }

    static Optional<RecordingExtent> span(MongoCollection<RawBsonDocument> collection) {
        RawBsonDocument first = outermost(collection, Sorts.ascending(EventDocumentCodec.TIME));
        RawBsonDocument last = outermost(collection, Sorts.descending(EventDocumentCodec.TIME));
        return first == null || last == null
                ? Optional.empty()
                : Optional.of(new RecordingExtent(OrderedDocumentReader.time(first), OrderedDocumentReader.time(last)));
    }

    private static RawBsonDocument outermost(MongoCollection<RawBsonDocument> collection, Bson order) {
        return collection
                .find(Filters.and(TIMED, OrderedDocumentReader.NOT_ARRAY))
                .sort(order)
                .projection(Projections.include(EventDocumentCodec.TIME))
                .first();
    }

    @Override
    public EventPage read(Cursor after, PageLimits limits) throws RecordingException {
        boolean continues = documents != null && after.equals(position);
        EventPage eventPage = continues ? continueOrRestart(after, limits) : restart(after, limits);
        position = eventPage.next();
        if (eventPage.last()) {
            reset(); // later documents need a new query
            if (!run(this::exists)) {
                throw new RecordingDeletedException(
                        "Mission %s has been deleted from %s while it was read".formatted(mission, where));
            }
        }
        return eventPage;
    }

    /** Continues the query, or restarts it if the server closed it after a long pause or the connection was lost. */
    private EventPage continueOrRestart(Cursor after, PageLimits limits) throws RecordingException {
        try {
            return page(after, limits);
        } catch (MongoException e) {
            return restart(after, limits);
        }
    }

    private EventPage restart(Cursor after, PageLimits limits) throws RecordingException {
        reset();
        return run(() -> {
            documents = new OrderedDocumentReader(collection, after, sizes);
            return page(after, limits);
        });
    }

    private EventPage page(Cursor after, PageLimits limits) {
        List<StoredEvent> events = new ArrayList<>();
        List<SkippedRecords> skipped = new ArrayList<>();
        if (after.equals(Cursor.START)) {
            untimed = untimed == null ? countUntimed() : untimed;
            if (untimed > 0) {
                skipped.add(new SkippedRecords("documents", "no event time: _time is missing or no date", untimed));
            }
        }
        Cursor next = after;
        int read = 0;
        long bytes = 0;
        OrderedDocumentReader.Ordered head = documents.peek();
        while (head != null && read < limits.events() && (read == 0 || bytes + head.bytes() <= limits.bytes())) {
            read(head, events, skipped);
            read++;
            bytes += head.bytes();
            next = head.cursor();
            documents.remove();
            head = documents.peek();
        }
        return new EventPage(events, skipped, next, head == null);
    }

    /** Counts the documents without an event time; zero after a timeout, so that long missions begin without delay. */
    private long countUntimed() {
        try {
            return collection.countDocuments(UNTIMED, new CountOptions().maxTime(COUNT_SECONDS, TimeUnit.SECONDS));
        } catch (MongoExecutionTimeoutException e) {
            LOG.info("Mission {} is too long to count its documents without an event time", mission);
            return 0;
        }
    }

    private static void read(
            OrderedDocumentReader.Ordered head, List<StoredEvent> events, List<SkippedRecords> skipped) {
        try {
            events.add(head.event());
        } catch (UnreadableException e) {
            skipped.add(new SkippedRecords("document " + head.id(), e.getMessage(), 1));
        }
    }

    /** Uses a separate query that reads backwards; pages continue. */
    @Override
    public Cursor back(Cursor from, Cursor first, long count, Predicate<StoredEvent> desired, PageLimits limits)
            throws RecordingException {
        StepBack.check(count);
        ReverseEventCounter documents = new ReverseEventCounter(collection, first, desired, sizes);
        try {
            return documents.cursor(from, count);
        } catch (MongoException e) {
            throw MongoRecordings.unreadable(mission, where, e);
        }
    }

    /** Reads the newest documents, or the whole mission if that needs too many of them or the mission has no index. */
    @Override
    public List<StoredEvent> stateBefore(long time, Set<String> entities, PageLimits limits) throws RecordingException {
        Optional<List<StoredEvent>> found;
        try {
            indexed = indexed == null ? MissionCollections.hasIndexes(database()) : indexed;
            found = indexed
                    ? new StateBefore(collection, time, entities, StateBefore.Bounds.INDEXED).read()
                    : Optional.empty();
        } catch (MongoCommandException e) {
            LOG.debug("The newest documents of mission {} cannot be found by an index", mission, e);
            found = Optional.empty();
        } catch (MongoException e) {
            throw MongoRecordings.unreadable(mission, where, e);
        }
        return found.isPresent() ? found.get() : Recording.super.stateBefore(time, entities, limits);
    }

    private MongoDatabase database() {
        return client.client().getDatabase(collection.getNamespace().getDatabaseName());
    }

    private boolean exists() {
        return MongoRecordings.exists(database(), collection.getNamespace().getCollectionName());
    }

    private <T> T run(Supplier<T> query) throws RecordingException {
        try {
            return query.get();
        } catch (MongoException e) {
            reset();
            throw MongoRecordings.unreadable(mission, where, e);
        }
    }

    private void reset() {
        if (documents != null) {
            OrderedDocumentReader open = documents;
            documents = null;
            open.close();
        }
    }

    @Override
    public void close() {
        reset();
        client.close();
    }
}
