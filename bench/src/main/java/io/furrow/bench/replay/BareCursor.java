package io.furrow.bench.replay;

import java.util.HashSet;
import java.util.Set;
import java.util.concurrent.atomic.AtomicReference;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.MongoCursor;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.Sorts;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.bson.BsonDateTime;
import org.bson.RawBsonDocument;

import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.MongoAccess;
import io.furrow.model.control.replay.WantedReplay;
import io.furrow.model.ngsi.UnreadableException;

/** Reads a mission by event time with a cursor of MongoDB's driver, decodes each document and sends its record, in one thread. */
final class BareCursor {
    /** As a recording in MongoDB is read. */
    static final int PART = 10_000;

    private static final int BATCH = 500;

    private final String mongo;
    private final WantedReplay replay;
    private final int most;
    private final int perQuery;
    private final AtomicReference<Exception> lost = new AtomicReference<>();
    private final Set<String> atTime = new HashSet<>();
    private long time = Long.MIN_VALUE;
    private long sequence;

    /**
     * @param most events
     * @param perQuery documents of one query, more than are of one millisecond
     */
    BareCursor(String mongo, WantedReplay replay, int most, int perQuery) {
        this.mongo = mongo;
        this.replay = replay;
        this.most = most;
        this.perQuery = perQuery;
    }

    void write(KafkaProducer<byte[], byte[]> producer) throws UnreadableException {
        try (MongoClient client = MongoClients.create(mongo)) {
            MongoCollection<RawBsonDocument> collection = client.getDatabase(MongoAccess.DATABASE)
                    .getCollection(MissionCollections.nameOf(replay.mission()), RawBsonDocument.class);
            int found;
            do {
                found = writePart(collection, producer);
            } while (found == perQuery && sequence < most);
        }
        producer.flush();
        if (lost.get() != null) {
            throw new IllegalStateException("a record was not written", lost.get());
        }
    }

    private int writePart(MongoCollection<RawBsonDocument> collection, KafkaProducer<byte[], byte[]> producer)
            throws UnreadableException {
        int found = 0;
        try (MongoCursor<RawBsonDocument> documents = collection
                .find(Filters.gte(EventDocumentCodec.TIME, new BsonDateTime(time)))
                .sort(Sorts.ascending(EventDocumentCodec.TIME))
                .limit(perQuery)
                .batchSize(BATCH)
                .cursor()) {
            for (; sequence < most && documents.hasNext(); found++) {
                StoredEvent event = EventDocumentCodec.read(documents.next());
                if (isNew(event)) {
                    producer.send(
                            PlayedRecord.written(event, replay, sequence++, event.time()),
                            (done, failure) -> lost.compareAndSet(null, failure));
                }
            }
        }
        return found;
    }

    private boolean isNew(StoredEvent event) {
        if (event.time() > time) {
            time = event.time();
            atTime.clear();
        }
        return atTime.add(event.id());
    }
}
