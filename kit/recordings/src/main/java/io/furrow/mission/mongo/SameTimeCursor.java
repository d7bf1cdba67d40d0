package io.furrow.mission.mongo;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.Iterator;
import java.util.List;

import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Projections;
import org.bson.BsonDateTime;
import org.bson.BsonValue;
import org.bson.RawBsonDocument;

import io.furrow.mission.Cursor;
import io.furrow.mission.mongo.OrderedDocumentReader.Ordered;

/** The documents of a millisecond that has too many to be held at once: holds their ids and reads a few at a time, large ones alone. */
final class SameTimeCursor implements Iterator<List<Ordered>> {
    private static final int MAX_AT_A_TIME = 16;
    private static final int BATCH = 10_000;

    private final MongoCollection<RawBsonDocument> collection;
    private final long mostBytes;
    private final List<BsonValue> ids = new ArrayList<>();
    private int next;
    private int atATime = MAX_AT_A_TIME;

    /** @param mostBytes of documents that are given at once, unless it is one */
    SameTimeCursor(MongoCollection<RawBsonDocument> collection, long time, Cursor after, long mostBytes) {
        this.collection = collection;
        this.mostBytes = mostBytes;
        try (MongoCursor<RawBsonDocument> found = collection
                .find(Filters.and(
                        Filters.eq(EventDocumentCodec.TIME, new BsonDateTime(time)), OrderedDocumentReader.ONE_TIME))
                .projection(Projections.include(EventDocumentCodec.ID))
                .batchSize(BATCH)
                .cursor()) {
            while (found.hasNext()) {
                BsonValue id = found.next().get(EventDocumentCodec.ID);
                if (new Cursor(time, OrderedDocumentReader.text(id)).compareTo(after) > 0) {
                    ids.add(id);
                }
            }
        }
        ids.sort(Comparator.comparing(OrderedDocumentReader::text));
    }

    @Override
    public boolean hasNext() {
        return next < ids.size();
    }

    /** The next documents; fewer where some have gone. */
    @Override
    public List<Ordered> next() {
        List<Ordered> documents = read();
        if (atATime > 1 && bytes(documents) > mostBytes) {
            documents.clear(); // not all were read, and a later one may be the first by id
            atATime = 1;
            documents = read();
        }
        next = Math.min(next + atATime, ids.size());
        atATime = Math.min(2 * atATime, MAX_AT_A_TIME);
        return documents;
    }

    /** Ends with the document that passes the limit. */
    private List<Ordered> read() {
        List<BsonValue> some = ids.subList(next, Math.min(next + atATime, ids.size()));
        List<Ordered> documents = new ArrayList<>();
        try (MongoCursor<RawBsonDocument> found =
                collection.find(Filters.in(EventDocumentCodec.ID, some)).cursor()) {
            while (bytes(documents) <= mostBytes && found.hasNext()) {
                documents.add(Ordered.of(found.next()));
            }
        }
        documents.sort(Ordered.BY_ID);
        return documents;
    }

    private static long bytes(List<Ordered> documents) {
        return documents.stream().mapToLong(Ordered::bytes).sum();
    }
}
