package io.furrow.bench.replay;

import java.util.HashSet;
import java.util.Set;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Sorts;
import org.bson.BsonDateTime;
import org.bson.BsonType;
import org.bson.RawBsonDocument;
import org.bson.conversions.Bson;

import io.furrow.bench.frame.TopicFiller;
import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.replay.record.EventEncoder;

/** Reads a mission by event time with a cursor of MongoDB's driver, decodes each document and sends its record, in one thread. */
final class BaselineCursor {
    /**
     * The size of the first query, as for a recording in MongoDB; a full one is followed by one twice as large, within the limit
     * of bytes.
     */
    static final int FIRST_QUERY = 2_000;

    private static final long QUERY_BYTES = Math.max(
            2L * 1024 * 1024, Math.min(64L * 1024 * 1024, Runtime.getRuntime().maxMemory() / 256));
    private static final int BATCH = 500;
    private static final Bson ONE_TIME = Filters.not(Filters.type(EventDocumentCodec.TIME, BsonType.ARRAY));

    private final String mongo;
    private final DesiredReplay replay;
    private final EventEncoder encoder;
    private final int most;
    private int perQuery;
    private final Set<String> atTime = new HashSet<>();
    private long time = Long.MIN_VALUE;
    private long sequence;

    /**
     * @param most maximum number of events
     * @param perQuery documents of the first query, more than share one millisecond
     */
    BaselineCursor(String mongo, DesiredReplay replay, int most, int perQuery) {
        this.mongo = mongo;
        this.replay = replay;
        this.encoder = PlayedRecord.encoder(replay);
        this.most = most;
        this.perQuery = perQuery;
    }

    void write(TopicFiller producer) throws UnreadableException {
        try (MongoClient client = MongoClients.create(mongo)) {
            MongoCollection<RawBsonDocument> collection = client.getDatabase(MongoAccess.DATABASE)
                    .getCollection(MissionCollections.nameOf(replay.mission()), RawBsonDocument.class);
            boolean more;
            do {
                more = writePart(collection, producer);
            } while (more && sequence < most);
        }
        producer.flush();
    }

    /** Whether there may be more. */
    private boolean writePart(MongoCollection<RawBsonDocument> collection, TopicFiller producer)
            throws UnreadableException {
        int found = 0;
        long bytes = 0;
        try (MongoCursor<RawBsonDocument> documents = collection
                .find(Filters.and(Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(time)), ONE_TIME))
                .sort(Sorts.ascending(EventDocumentCodec.TIME))
                .limit(perQuery)
                .batchSize(BATCH)
                .cursor()) {
            for (; sequence < most && documents.hasNext(); found++) {
                RawBsonDocument document = documents.next();
                bytes += document.getByteBuffer().remaining();
                StoredEvent event = EventDocumentCodec.read(document);
                if (isNew(event)) {
                    producer.send(PlayedRecord.written(event, replay, encoder, sequence++, event.time()));
                }
            }
        }
        boolean full = found == perQuery;
        perQuery = full && bytes <= QUERY_BYTES / 2 ? 2 * perQuery : perQuery;
        return full;
    }

    private boolean isNew(StoredEvent event) {
        if (event.time() > time) {
            time = event.time();
            atTime.clear();
        }
        return atTime.add(event.id());
    }
}
