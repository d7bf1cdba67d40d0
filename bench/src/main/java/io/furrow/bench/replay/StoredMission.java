package io.furrow.bench.replay;

import java.nio.charset.StandardCharsets;
import java.time.Clock;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Random;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import org.bson.RawBsonDocument;

import io.furrow.mission.StoredEvent;
import io.furrow.mission.mongo.EventDocumentCodec;
import io.furrow.mission.mongo.MissionCollections;
import io.furrow.mission.mongo.Retention;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A mission with events at random times, at an average rate; reproducible.
 *
 * @param perSecond of event time
 * @param seed of the spacing
 */
record StoredMission(String name, int events, int perSecond, long seed) {
    /** Event time of the first event, epoch ms. */
    static final long BEGIN = 1_700_000_000_000L;

    private static final int DEVICES = 50;
    private static final int BULK = 5_000;
    private static final double MILLIS = 1_000;

    /** Generates the events, in the order of event time. */
    void forEach(Consumer<StoredEvent> out) {
        Random random = new Random(seed);
        double time = BEGIN;
        for (int number = 0; number < events; number++) {
            out.accept(event(number, (long) time));
            time -= Math.log(1 - random.nextDouble()) * MILLIS / perSecond;
        }
    }

    List<StoredEvent> all() {
        List<StoredEvent> all = new ArrayList<>(events);
        forEach(all::add);
        return all;
    }

    void store(String mongo) {
        try (MongoClient client = MongoClients.create(mongo)) {
            MissionCollections missions =
                    new MissionCollections(client, Retention.of(null, Map.of()), Clock.systemUTC());
            MongoCollection<RawBsonDocument> collection = missions.prepared(MissionCollections.nameOf(name));
            List<RawBsonDocument> bulk = new ArrayList<>(BULK);
            forEach(event -> {
                bulk.add(document(event));
                if (bulk.size() == BULK) {
                    collection.insertMany(bulk);
                    bulk.clear();
                }
            });
            if (!bulk.isEmpty()) {
                collection.insertMany(bulk);
            }
        }
    }

    private static RawBsonDocument document(StoredEvent event) {
        try {
            return new RawBsonDocument(EventDocumentCodec.write(event));
        } catch (UnreadableException e) {
            throw new IllegalStateException("an event cannot be stored", e);
        }
    }

    private static StoredEvent event(int number, long time) {
        String id = "urn:ngsi-ld:Robot:" + number % DEVICES;
        String json = """
                {"id":"%s","type":"Robot",\
                "Latitude":{"type":"Float","value":40.313%03d,"metadata":{}},\
                "Longitude":{"type":"Float","value":-3.483%03d,"metadata":{}},\
                "Speed":{"type":"Float","value":1.%d,"metadata":{}},\
                "Battery":{"type":"Integer","value":%d,"metadata":{}},\
                "Time":{"type":"Integer","value":%d,"metadata":{}},\
                "State":{"type":"String","value":"working","metadata":{}}}""".formatted(id, number % 1000, number % 997, number % 10, number % 101, time);
        Map<String, String> headers = new HashMap<>();
        headers.put(HeaderNames.CE_SOURCE, "/bench");
        headers.put(HeaderNames.CE_TYPE, HeaderNames.TYPE_CHANGED);
        headers.put(HeaderNames.SERVICE, "farm");
        headers.put(HeaderNames.SERVICE_PATH, "/");
        headers.put(HeaderNames.ORIGIN, "notification");
        headers.put(HeaderNames.TS_DEVICE, Long.toString(time));
        headers.put(HeaderNames.TS_SOURCE, Long.toString(time + 3));
        headers.put(HeaderNames.TS_INGEST, Long.toString(time + 9));
        return new StoredEvent(
                "%016x%08x".formatted(number * 0x9E3779B97F4A7C15L, number), time, id, headers, entity(json));
    }

    private static ObjectNode entity(String json) {
        try {
            return (ObjectNode) NgsiJson.read(json.getBytes(StandardCharsets.UTF_8));
        } catch (UnreadableException e) {
            throw new IllegalStateException("an event is not JSON", e);
        }
    }
}
