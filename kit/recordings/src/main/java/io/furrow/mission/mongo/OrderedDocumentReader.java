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
 * Reads the documents of a mission in the order of events after a cursor. Queries sort by event time only, which has an
 * index; the documents of a millisecond are sorted here, because MongoDB orders some ids differently from Java's
 * strings. Holds the documents of one millisecond; if there are too many, their ids.
 */
final class OrderedDocumentReader implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(OrderedDocumentReader.class);
    private static final int BATCH = 500;

    /** Excludes arrays with a date, which a comparison with a date also matches. */
    static final Bson NOT_ARRAY = Filters.not(Filters.type(EventDocumentCodec.TIME, BsonType.ARRAY));

    private final MongoCollection<RawBsonDocument> collection;
    private final Cursor after;
    private final Sizes sizes;
    private final Deque<Ordered> ready = new ArrayDeque<>();
    private Bson range;
    /** The open query; null between queries. */
    private MongoCursor<RawBsonDocument> query;

    /** Limit of the current or next query. */
    private int limit;

    private int fetched;
    private long fetchedBytes;
    /** The next document of the query; null at its end. */
    private RawBsonDocument following;
    /** Reads a millisecond with too many documents; otherwise null. */
    private SameTimeCursor sameTimeCursor;

    /**
     * Sizes of reads.
     *
     * @param firstLimit documents of the first query
     * @param queryBytes the limit is doubled after a full query while the expected bytes of its documents stay within
     * this size, because the embedded server holds the possible result of a query in memory
     * @param maxSameTime documents of one millisecond above which they are read by id; less than {@code firstLimit}
     * @param maxSameTimeBytes bytes of one millisecond above which documents are read by id, in parts of this size
     */
    record Sizes(int firstLimit, long queryBytes, int maxSameTime, long maxSameTimeBytes) {
        private static final long MAX_BYTES = 64L * 1024 * 1024;
        private static final long MIN_BYTES = 2L * 1024 * 1024;
        /** The embedded server needs twenty times the bytes of a query's documents on the heap until all are read. */
        private static final long HEAP_SHARE = 256;

        static final Sizes DEFAULT =
                new Sizes(2_000, queryBytes(Runtime.getRuntime().maxMemory()), 1_000, 8L * 1024 * 1024);

        /** @param heap bytes */
        static long queryBytes(long heap) {
            return Math.max(MIN_BYTES, Math.min(MAX_BYTES, heap / HEAP_SHARE));
        }

        /**
         * Returns the next limit.
         *
         * @param bytes of the documents of a full query with this limit
         */
        int next(int limit, long bytes) {
            return bytes <= queryBytes / 2 && limit <= Integer.MAX_VALUE / 2 ? 2 * limit : limit;
        }
    }

    /**
     * A document and its place in the order.
     *
     * @param id its {@code _id} as text
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

        /** @throws UnreadableException if the document is not an event */
        StoredEvent event() throws UnreadableException {
            return OrderedDocumentReader.event(document);
        }
    }

    /** @throws UnreadableException if the document is not an event */
    static StoredEvent event(BsonDocument document) throws UnreadableException {
        BsonValue id = document.get(EventDocumentCodec.ID);
        Reason.NOT_AN_EVENT.refuseIf(!id.isString() || text(id).isEmpty(), "_id is not an event id");
        try {
            return EventDocumentCodec.read(document);
        } catch (BSONException | ArithmeticException e) { // ArithmeticException for a decimal −0
            throw new UnreadableException(Reason.NOT_AN_EVENT, FailureText.of(e));
        }
    }

    OrderedDocumentReader(MongoCollection<RawBsonDocument> collection, Cursor after, Sizes sizes) {
        this.collection = collection;
        this.after = after;
        this.sizes = sizes;
        this.limit = sizes.firstLimit();
        this.range = Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(after.time()));
    }

    /** Returns the next document without consuming it; null if there is none now. */
    Ordered peek() {
        while (ready.isEmpty()) {
            if (sameTimeCursor != null) {
                readSameTimeCursor();
            } else if (head() == null) {
                return null;
            } else {
                readMillisecond(time(following));
            }
        }
        return ready.peek();
    }

    void remove() {
        ready.remove();
    }

    private void readSameTimeCursor() {
        if (sameTimeCursor.hasNext()) {
            ready.addAll(sameTimeCursor.next());
        } else {
            sameTimeCursor = null;
        }
    }

    private RawBsonDocument head() {
        if (query == null) {
            query = collection
                    .find(Filters.and(range, NOT_ARRAY))
                    .sort(Sorts.ascending(EventDocumentCodec.TIME))
                    .limit(limit)
                    .batchSize(BATCH)
                    .cursor();
            fetched = 0;
            fetchedBytes = 0;
            advance();
        }
        return following;
    }

    private void advance() {
        following = query.hasNext() ? query.next() : null;
        if (following != null) {
            fetched++;
            fetchedBytes += following.getByteBuffer().remaining();
        }
    }

    /** Reads the documents of one millisecond. */
    private void readMillisecond(long time) {
        List<Ordered> documents = new ArrayList<>();
        int read = 0;
        long bytes = 0;
        while (following != null && time(following) == time) {
            if (read == sizes.maxSameTime() || bytes > sizes.maxSameTimeBytes()) {
                closeQuery();
                sameTimeCursor = new SameTimeCursor(collection, time, after, sizes.maxSameTimeBytes());
                range = Filters.gt(EventDocumentCodec.TIME, new BsonDateTime(time));
                return;
            }
            Ordered next = Ordered.of(following);
            if (next.cursor().compareTo(after) > 0) {
                documents.add(next);
                bytes += next.bytes();
            }
            read++;
            advance();
        }
        boolean truncated = following == null && fetched == limit;
        if (truncated) {
            closeQuery();
            limit = sizes.next(limit, fetchedBytes);
            range = Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(time));
            return;
        }
        documents.sort(Ordered.BY_ID);
        ready.addAll(documents);
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
            LOG.debug("Cannot close a query; the server closes it after a timeout", e);
        }
    }

    @Override
    public void close() {
        closeQuery();
    }
}
