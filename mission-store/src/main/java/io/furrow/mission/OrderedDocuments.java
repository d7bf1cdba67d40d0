package io.furrow.mission;

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
import org.bson.BsonDateTime;
import org.bson.BsonValue;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * Reads the documents of a mission in the order of events, beginning after a cursor. Queries ask for event time alone, which has
 * an index; the documents of one millisecond are sorted here, in the order of Java's strings, which is not MongoDB's for every id.
 * Holds the documents of one millisecond, and of a crowded one their ids.
 */
final class OrderedDocuments implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(OrderedDocuments.class);
    private static final int BATCH = 500;

    private final MongoCollection<RawBsonDocument> collection;
    private final Cursor after;
    private final Sizes sizes;
    private final Deque<Ordered> ready = new ArrayDeque<>();
    private Bson range;
    /** Null between queries. */
    private MongoCursor<RawBsonDocument> query;

    private int fetched;
    /** The next document of the query; null at its end. */
    private RawBsonDocument ahead;
    /** Null unless a crowded millisecond is being read. */
    private CrowdedMillisecond crowd;

    /**
     * How much is read at once.
     *
     * @param perQuery documents of one query; the embedded server sorts in memory what a query may return
     * @param crowd more documents of one millisecond than these are read by ids; less than {@code perQuery}
     * @param crowdBytes as are more bytes of one millisecond than these
     */
    record Sizes(int perQuery, int crowd, long crowdBytes) {
        static final Sizes DEFAULT = new Sizes(10_000, 1_000, 8L * 1024 * 1024);
    }

    /**
     * A document and its place in the order.
     *
     * @param id the text of its {@code _id}
     */
    record Ordered(long time, String id, RawBsonDocument document) {
        static final Comparator<Ordered> BY_ID = Comparator.comparing(Ordered::id);

        static Ordered of(RawBsonDocument document) {
            return new Ordered(OrderedDocuments.time(document), text(document.get(DocumentForm.ID)), document);
        }

        int bytes() {
            return document.getByteBuffer().remaining();
        }

        Cursor cursor() {
            return new Cursor(time, id);
        }
    }

    OrderedDocuments(MongoCollection<RawBsonDocument> collection, Cursor after, Sizes sizes) {
        this.collection = collection;
        this.after = after;
        this.sizes = sizes;
        this.range = Filters.gte(DocumentForm.TIME, new BsonDateTime(after.time()));
    }

    /** The next document, which stays the next; null where there is none at this moment. */
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
                    .find(range)
                    .sort(Sorts.ascending(DocumentForm.TIME))
                    .limit(sizes.perQuery())
                    .batchSize(BATCH)
                    .cursor();
            fetched = 0;
            advance();
        }
        return ahead;
    }

    /** Goes on to the next document whose time is a date; an array of dates matches the query as well. */
    private void advance() {
        do {
            ahead = query.hasNext() ? query.next() : null;
            fetched += ahead == null ? 0 : 1;
        } while (ahead != null && !ahead.get(DocumentForm.TIME).isDateTime());
    }

    /** Reads the documents of one millisecond. */
    private void gather(long time) {
        List<Ordered> same = new ArrayList<>();
        int read = 0;
        long bytes = 0;
        while (ahead != null && time(ahead) == time) {
            if (read == sizes.crowd() || bytes > sizes.crowdBytes()) {
                closeQuery();
                crowd = new CrowdedMillisecond(collection, time, after);
                range = Filters.gt(DocumentForm.TIME, new BsonDateTime(time));
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
        boolean cutOff = ahead == null && fetched == sizes.perQuery();
        if (cutOff) {
            closeQuery();
            range = Filters.gte(DocumentForm.TIME, new BsonDateTime(time));
            return;
        }
        same.sort(Ordered.BY_ID);
        ready.addAll(same);
    }

    static long time(RawBsonDocument document) {
        return document.getDateTime(DocumentForm.TIME).getValue();
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
