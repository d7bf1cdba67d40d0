package io.furrow.mission.mongo;

import java.util.ArrayDeque;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.Deque;
import java.util.List;

import com.mongodb.MongoException;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Sorts;
import org.bson.BSONException;
import org.bson.BsonDateTime;
import org.bson.BsonDocument;
import org.bson.BsonType;
import org.bson.BsonValue;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.mission.Cursor;
import io.furrow.mission.StoredEvent;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.model.text.FailureText;

/**
 * Reads the documents of a mission in the order of events, beginning after a cursor. Queries ask for event time alone, which has
 * an index; the documents of one millisecond are sorted here, in the order of Java's strings, which is not MongoDB's for every id.
 * Holds the documents of one millisecond, and of a crowded one their ids.
 */
final class OrderedDocumentReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(OrderedDocumentReader.class);
    private static final int BATCH = 500;

    /** What a comparison with a date finds besides dates: arrays that hold one. */
    static final Bson ONE_TIME = Filters.not(Filters.type(EventDocumentCodec.TIME, BsonType.ARRAY));

    private final MongoCollection<RawBsonDocument> collection;
    private final Cursor after;
    private final Sizes sizes;
    private final Deque<Ordered> ready = new ArrayDeque<>();
    private Bson range;
    /** Null between queries. */
    private MongoCursor<RawBsonDocument> query;

    /** Of the present query, or the next. */
    private int limit;

    private int fetched;
    private long fetchedBytes;
    /** The next document of the query; null at its end. */
    private RawBsonDocument ahead;
    /** Null unless a crowded millisecond is being read. */
    private SameTimeCursor crowd;

    /**
     * How much is read at once.
     *
     * @param perQuery documents of the first query
     * @param queryBytes a query that follows on a full one is twice as long, as long as its documents are expected to be within
     *     these: the embedded server holds in memory what a query may return
     * @param crowd more documents of one millisecond than these are read by ids; less than {@code perQuery}
     * @param crowdBytes as are more bytes of one millisecond than these, this many at a time
     */
    record Sizes(int perQuery, long queryBytes, int crowd, long crowdBytes) {
        private static final long MAX_BYTES = 64L * 1024 * 1024;
        private static final long MIN_BYTES = 2L * 1024 * 1024;
        /** The embedded server has twenty times the bytes of a query's documents on the heap until it is read to its end. */
        private static final long HEAP_SHARE = 256;

        static final Sizes DEFAULT =
                new Sizes(2_000, queryBytes(Runtime.getRuntime().maxMemory()), 1_000, 8L * 1024 * 1024);

        /** @param heap bytes */
        static long queryBytes(long heap) {
            return Math.max(MIN_BYTES, Math.min(MAX_BYTES, heap / HEAP_SHARE));
        }

        /** @param bytes of the documents of a query with this limit that was full */
        int next(int limit, long bytes) {
            return bytes <= queryBytes / 2 && limit <= Integer.MAX_VALUE / 2 ? 2 * limit : limit;
        }
    }

    /**
     * A document and its place in the order.
     *
     * @param id the text of its {@code _id}
     */
    record Ordered(long time, String id, RawBsonDocument document) {
        static final Comparator<Ordered> BY_ID = Comparator.comparing(Ordered::id);

        static Ordered of(RawBsonDocument document) {
            return new Ordered(
                    OrderedDocumentReader.time(document), text(document.get(EventDocumentCodec.ID)), document);
        }

        int bytes() {
            return document.getByteBuffer().remaining();
        }

        Cursor cursor() {
            return new Cursor(time, id);
        }

        /** @throws UnreadableException for a document that holds no event */
        StoredEvent event() throws UnreadableException {
            return OrderedDocumentReader.event(document);
        }
    }

    /** @throws UnreadableException for a document that holds no event */
    static StoredEvent event(BsonDocument document) throws UnreadableException {
        BsonValue id = document.get(EventDocumentCodec.ID);
        Reason.NOT_AN_EVENT.refuseIf(!id.isString() || text(id).isEmpty(), "_id is not an event id");
        try {
            return EventDocumentCodec.read(document);
        } catch (BSONException | ArithmeticException e) { // the latter for a decimal −0
            throw new UnreadableException(Reason.NOT_AN_EVENT, FailureText.of(e));
        }
    }

    OrderedDocumentReader(MongoCollection<RawBsonDocument> collection, Cursor after, Sizes sizes) {
        this.collection = collection;
        this.after = after;
        this.sizes = sizes;
        this.limit = sizes.perQuery();
        this.range = Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(after.time()));
    }

    /** The next document, which stays the next; null if there is none at this moment. */
    Ordered peek() {
        while (ready.isEmpty()) {
            if (crowd != null) {
                readCrowd();
            } else if (head() == null) {
                return null;
            } else {
                gather(time(ahead));
            }
        }
        return ready.peek();
    }

    void remove() {
        ready.remove();
    }

    private void readCrowd() {
        if (crowd.hasNext()) {
            ready.addAll(crowd.next());
        } else {
            crowd = null;
        }
    }

    private RawBsonDocument head() {
        if (query == null) {
            query = collection
                    .find(Filters.and(range, ONE_TIME))
                    .sort(Sorts.ascending(EventDocumentCodec.TIME))
                    .limit(limit)
                    .batchSize(BATCH)
                    .cursor();
            fetched = 0;
            fetchedBytes = 0;
            advance();
        }
        return ahead;
    }

    private void advance() {
        ahead = query.hasNext() ? query.next() : null;
        if (ahead != null) {
            fetched++;
            fetchedBytes += ahead.getByteBuffer().remaining();
        }
    }

    /** Reads the documents of one millisecond. */
    private void gather(long time) {
        List<Ordered> same = new ArrayList<>();
        int read = 0;
        long bytes = 0;
        while (ahead != null && time(ahead) == time) {
            if (read == sizes.crowd() || bytes > sizes.crowdBytes()) {
                closeQuery();
                crowd = new SameTimeCursor(collection, time, after, sizes.crowdBytes());
                range = Filters.gt(EventDocumentCodec.TIME, new BsonDateTime(time));
                return;
            }
            Ordered next = Ordered.of(ahead);
            if (next.cursor().compareTo(after) > 0) {
                same.add(next);
                bytes += next.bytes();
            }
            read++;
            advance();
        }
        boolean cutOff = ahead == null && fetched == limit;
        if (cutOff) {
            closeQuery();
            limit = sizes.next(limit, fetchedBytes);
            range = Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(time));
            return;
        }
        same.sort(Ordered.BY_ID);
        ready.addAll(same);
    }

    static long time(RawBsonDocument document) {
        return document.getDateTime(EventDocumentCodec.TIME).getValue();
    }

    static String text(BsonValue id) {
        return id != null && id.isString() ? id.asString().getValue() : String.valueOf(id);
    }

    private void closeQuery() {
        MongoCursor<RawBsonDocument> open = query;
        query = null;
        try {
            if (open != null) {
                open.close();
            }
        } catch (MongoException e) {
            LOG.debug("a query could not be ended; the server forgets it by itself", e);
        }
    }

    @Override
    public void close() {
        closeQuery();
    }
}
