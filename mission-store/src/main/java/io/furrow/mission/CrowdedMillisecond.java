package io.furrow.mission;

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

import io.furrow.mission.OrderedDocuments.Ordered;

/** The documents of a millisecond that has too many to be held at once: holds their ids and reads a few at a time. */
final class CrowdedMillisecond implements Iterator<List<Ordered>> {
    private static final int AT_A_TIME = 16;
    private static final int BATCH = 10_000;

    private final MongoCollection<RawBsonDocument> collection;
    private final List<BsonValue> ids = new ArrayList<>();
    private int next;

    CrowdedMillisecond(MongoCollection<RawBsonDocument> collection, long time, Cursor after) {
        this.collection = collection;
        try (MongoCursor<RawBsonDocument> found = collection
                .find(Filters.eq(DocumentForm.TIME, new BsonDateTime(time)))
                .projection(Projections.include(DocumentForm.ID))
                .batchSize(BATCH)
                .cursor()) {
            while (found.hasNext()) {
                BsonValue id = found.next().get(DocumentForm.ID);
                if (new Cursor(time, OrderedDocuments.text(id)).compareTo(after) > 0) {
                    ids.add(id);
                }
            }
        }
        ids.sort(Comparator.comparing(OrderedDocuments::text));
    }

    @Override
    public boolean hasNext() {
        return next < ids.size();
    }

    /** The next documents; fewer where some have gone. */
    @Override
    public List<Ordered> next() {
        List<BsonValue> some = ids.subList(next, Math.min(next + AT_A_TIME, ids.size()));
        next += some.size();
        List<Ordered> documents = new ArrayList<>();
        collection.find(Filters.in(DocumentForm.ID, some)).forEach(document -> documents.add(Ordered.of(document)));
        documents.sort(Ordered.BY_ID);
        return documents;
    }
}
