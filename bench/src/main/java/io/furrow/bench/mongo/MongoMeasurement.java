package io.furrow.bench.mongo;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.client.model.BulkWriteOptions;
import com.mongodb.client.model.Filters;
import com.mongodb.client.model.ReplaceOneModel;
import com.mongodb.client.model.ReplaceOptions;
import com.mongodb.client.model.WriteModel;
import jakarta.ws.rs.core.Context;
import org.apache.flink.api.connector.sink2.SinkWriter;
import org.bson.RawBsonDocument;

import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.mission.ComposeDocuments;
import io.furrow.ingest.mission.MissionDocument;
import io.furrow.ingest.mission.MissionEvent;
import io.furrow.ingest.mission.MissionSink;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Writes the same events into MongoDB in two ways alternately: as the job does (records of JSON through the composition of
 * documents and the sink writer, with periodic flushes for checkpoints), and in a bare loop around the driver (bulks of the same
 * upserts, prepared beforehand).
 */
final class MongoMeasurement {
    private static final String DATABASE = "persistence";
    private static final String MISSION = "bench";
    private static final int BULK = 1_000;
    private static final int CHECKPOINT = 20_000;
    private static final long TIME = 1_700_000_000_000L;

    private final String uri;
    private final int documents;
    private final List<MissionEvent> events;

    /** @param bytes of an event's JSON, approximately */
    MongoMeasurement(String uri, int documents, int bytes) {
        this.uri = uri;
        this.documents = documents;
        this.events = new ArrayList<>(documents);
        String filling = "x".repeat(Math.max(0, bytes - 250));
        for (int i = 0; i < documents; i++) {
            events.add(event(i, filling));
        }
    }

    /** Documents per second of a turn of the bare loop, into an empty collection. */
    double bare() throws UnreadableException {
        List<MissionDocument> ready = new ArrayList<>(documents);
        for (MissionEvent event : events) {
            ready.add(ComposeDocuments.compose(event));
        }
        BulkWriteOptions unordered = new BulkWriteOptions().ordered(false);
        ReplaceOptions upsert = new ReplaceOptions().upsert(true);
        try (MongoClient client = MongoClients.create(uri)) {
            client.getDatabase(DATABASE).drop();
            MongoCollection<RawBsonDocument> collection =
                    client.getDatabase(DATABASE).getCollection(ready.get(0).collection(), RawBsonDocument.class);
            long start = System.nanoTime();
            for (int from = 0; from < documents; from += BULK) {
                List<WriteModel<RawBsonDocument>> bulk = new ArrayList<>(BULK);
                for (MissionDocument document : ready.subList(from, Math.min(documents, from + BULK))) {
                    bulk.add(new ReplaceOneModel<>(
                            Filters.eq("_id", document.id()), new RawBsonDocument(document.bson()), upsert));
                }
                collection.bulkWrite(bulk, unordered);
            }
            return rate(start, collection);
        }
    }

    /** The same through the job's writer. */
    double writer() throws Exception {
        try (MongoClient client = MongoClients.create(uri)) {
            client.getDatabase(DATABASE).drop();
            MongoCollection<RawBsonDocument> collection = client.getDatabase(DATABASE)
                    .getCollection(ComposeDocuments.compose(events.get(0)).collection(), RawBsonDocument.class);
            long start = System.nanoTime();
            SinkWriter<MissionDocument> writer = MissionSink.writer(uri, new NoDeadLetters());
            try {
                for (int i = 0; i < documents; i++) {
                    writer.write(ComposeDocuments.compose(events.get(i)), null);
                    if (i % CHECKPOINT == CHECKPOINT - 1) {
                        writer.flush(false);
                    }
                }
                writer.flush(true);
                return rate(start, collection);
            } finally {
                writer.close();
            }
        }
    }

    private double rate(long start, MongoCollection<?> collection) {
        double seconds = (System.nanoTime() - start) / 1e9;
        long there = collection.countDocuments();
        if (there != documents) {
            throw new IllegalStateException(there + " documents are there, not " + documents);
        }
        return documents / seconds;
    }

    private static MissionEvent event(int number, String filling) {
        String json = """
                {"id":"urn:ngsi-ld:Thermometer:%d","type":"Thermometer",\
                "Temperature":{"type":"Float","value":%d.5,"metadata":{}},\
                "Latitude":{"type":"Float","value":40.313%03d,"metadata":{}},\
                "Time":{"type":"Integer","value":%d,"metadata":{}},\
                "Note":{"type":"String","value":"%s","metadata":{}}}""".formatted(number % 500, number % 40, number % 1000, TIME + number, filling);
        Map<String, String> headers = new HashMap<>();
        headers.put(HeaderNames.CE_ID, "%032x".formatted(number * 0x9E3779B97F4A7C15L));
        headers.put(HeaderNames.CE_SOURCE, "/bench");
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, "farm");
        headers.put(HeaderNames.SERVICE_PATH, "/");
        headers.put(HeaderNames.ORIGIN, "notification");
        headers.put(HeaderNames.TS_DEVICE, Long.toString(TIME + number));
        headers.put(HeaderNames.TS_SOURCE, Long.toString(TIME + number + 3));
        headers.put(HeaderNames.TS_INGEST, Long.toString(TIME + number + 9));
        return new MissionEvent(
                "",
                MISSION,
                TopicRecord.of("data.raw", TIME + number, "t", json.getBytes(StandardCharsets.UTF_8), headers));
    }

    /** A refused document would invalidate the figures. */
    private static final class NoDeadLetters implements SinkWriter<TopicRecord> {
        @Override
        public void write(TopicRecord record, Context context) throws IOException {
            throw new IOException("a document was refused: " + record.headers());
        }

        @Override
        public void flush(boolean endOfInput) {
            // stateless
        }

        @Override
        public void close() {
            // no resources
        }
    }
}
