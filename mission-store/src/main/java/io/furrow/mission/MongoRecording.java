package io.furrow.mission;

import java.util.ArrayList;
import java.util.List;
import java.util.Optional;
import java.util.function.Supplier;

import com.mongodb.MongoException;
import com.mongodb.MongoNamespace;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Projections;
import com.mongodb.client.model.Sorts;
import org.bson.BSONException;
import org.bson.BsonDateTime;
import org.bson.BsonType;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;

import io.furrow.model.ngsi.UnreadableException;

/** A mission in MongoDB. Pages that follow on one another share a query; any other begins one by event time. */
final class MongoRecording implements Recording {
    /** Dates alone: MongoDB compares a date with no value of another type. */
    private static final Bson TIMED = Filters.gte(DocumentForm.TIME, new BsonDateTime(Long.MIN_VALUE));

    private static final Bson UNTIMED = Filters.or(
            Filters.not(Filters.type(DocumentForm.TIME, BsonType.DATE_TIME)),
            Filters.type(DocumentForm.TIME, BsonType.ARRAY));

    private final String mission;
    private final MongoClient client;
    private final MongoCollection<RawBsonDocument> collection;
    private final String where;
    private final OrderedDocuments.Sizes sizes;
    /** What the next page may go on with; null where it begins anew. */
    private OrderedDocuments documents;

    private Cursor position = Cursor.START;
    /** Counted once, as no index helps; −1 until then. */
    private long untimed = -1;

    /** @param where for messages */
    MongoRecording(
            String mission,
            MongoClient client,
            MongoCollection<RawBsonDocument> collection,
            String where,
            OrderedDocuments.Sizes sizes) {
        this.mission = mission;
        this.client = client;
        this.collection = collection;
        this.where = where;
        this.sizes = sizes;
    }

    @Override
    public Optional<Span> span() throws RecordingException {
        return answer(() -> {
            RawBsonDocument first = outermost(Sorts.ascending(DocumentForm.TIME));
            RawBsonDocument last = outermost(Sorts.descending(DocumentForm.TIME));
            return first == null || last == null
                    ? Optional.empty()
                    : Optional.of(new Span(
                            OrderedDocuments.time(first),
                            OrderedDocuments.time(last),
                            collection.countDocuments(TIMED)));
        });
    }

    private RawBsonDocument outermost(Bson order) {
        return collection
                .find(Filters.and(TIMED, Filters.type(DocumentForm.TIME, BsonType.DATE_TIME)))
                .sort(order)
                .projection(Projections.include(DocumentForm.TIME))
                .first();
    }

    @Override
    public Page read(Cursor after, PageLimits limits) throws RecordingException {
        boolean goesOn = documents != null && after.equals(position);
        Page page = goesOn ? retried(after, limits) : begun(after, limits);
        position = page.next();
        if (page.last()) {
            begin(); // what comes later is asked for anew
            if (!answer(this::exists)) {
                throw new RecordingGoneException(
                        "Mission %s has been deleted from %s while it was read".formatted(mission, where));
            }
        }
        return page;
    }

    /** A query that rests for long is forgotten by the server, and lost with its connection: then it begins once more. */
    private Page retried(Cursor after, PageLimits limits) throws RecordingException {
        try {
            return page(after, limits);
        } catch (MongoException e) {
            return begun(after, limits);
        }
    }

    private Page begun(Cursor after, PageLimits limits) throws RecordingException {
        begin();
        return answer(() -> {
            documents = new OrderedDocuments(collection, after, sizes);
            return page(after, limits);
        });
    }

    private Page page(Cursor after, PageLimits limits) {
        List<StoredEvent> events = new ArrayList<>();
        List<Skipped> skipped = new ArrayList<>();
        if (after.equals(Cursor.START)) {
            untimed = untimed < 0 ? collection.countDocuments(UNTIMED) : untimed;
            if (untimed > 0) {
                skipped.add(new Skipped("documents", "no event time: _time is missing or no date", untimed));
            }
        }
        Cursor next = after;
        int read = 0;
        long bytes = 0;
        OrderedDocuments.Ordered head = documents.peek();
        while (head != null && read < limits.events() && (read == 0 || bytes + head.bytes() <= limits.bytes())) {
            read(head, events, skipped);
            read++;
            bytes += head.bytes();
            next = head.cursor();
            documents.remove();
            head = documents.peek();
        }
        return new Page(events, skipped, next, head == null);
    }

    private static void read(OrderedDocuments.Ordered head, List<StoredEvent> events, List<Skipped> skipped) {
        String reason;
        try {
            boolean named = head.document().get(DocumentForm.ID).isString()
                    && !head.id().isEmpty();
            if (named) {
                events.add(DocumentForm.read(head.document()));
                return;
            }
            reason = "_id is no event id";
        } catch (UnreadableException | BSONException | ArithmeticException e) { // the last for a decimal −0
            reason = e.getMessage();
        }
        skipped.add(new Skipped("document " + head.id(), reason, 1));
    }

    private boolean exists() {
        MongoNamespace name = collection.getNamespace();
        return MongoRecordings.exists(client.getDatabase(name.getDatabaseName()), name.getCollectionName());
    }

    private <T> T answer(Supplier<T> question) throws RecordingException {
        try {
            return question.get();
        } catch (MongoException e) {
            begin();
            throw MongoRecordings.unreadable(mission, where, e);
        }
    }

    private void begin() {
        if (documents != null) {
            OrderedDocuments open = documents;
            documents = null;
            open.close();
        }
    }

    @Override
    public void close() {
        client.close(); // with every cursor
    }
}
