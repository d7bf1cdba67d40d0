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

/** Reads a millisecond with too many documents for the memory, by ids and in small batches. */
final class SameTimeCursor implements Iterator<List<Ordered>> {
    private static final int MAX_BATCH = 16;
    private static final int ID_BATCH = 10_000;

    private final MongoCollection<RawBsonDocument> collection;
    private final long maxBytes;
    private final List<BsonValue> ids = new ArrayList<>();
    private int next;
    private int batch = MAX_BATCH;

    /** @param maxBytes maximum bytes of documents returned at once, unless a single one is larger */
    SameTimeCursor(MongoCollection<RawBsonDocument> collection, long time, Cursor after, long maxBytes) {
        this.collection = collection;
        this.maxBytes = maxBytes;
        try (MongoCursor<RawBsonDocument> found = collection
                .find(Filters.and(
                        Filters.eq(EventDocumentCodec.TIME, new BsonDateTime(time)), OrderedDocumentReader.NOT_ARRAY))
                .projection(Projections.include(EventDocumentCodec.ID))
                .batchSize(ID_BATCH)
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

    /** Returns the next documents; fewer if some were deleted. */
    @Override
    public List<Ordered> next() {
        List<Ordered> documents = read();
        if (batch > 1 && bytes(documents) > maxBytes) {
            documents.clear(); // the read is incomplete, and a later document may be the first by id
            batch = 1;
            documents = read();
        }
        next = Math.min(next + batch, ids.size());
        batch = Math.min(2 * batch, MAX_BATCH);
        return documents;
    }

    /** Reads until a document exceeds the limit. */
    private List<Ordered> read() {
        List<BsonValue> some = ids.subList(next, Math.min(next + batch, ids.size()));
        List<Ordered> documents = new ArrayList<>();
        try (MongoCursor<RawBsonDocument> found =
                collection.find(Filters.in(EventDocumentCodec.ID, some)).cursor()) {
            while (bytes(documents) <= maxBytes && found.hasNext()) {
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
