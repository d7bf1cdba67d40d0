package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.List;
import java.util.Optional;
import java.util.concurrent.CopyOnWriteArrayList;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoDatabase;
import org.bson.BsonDateTime;
import org.bson.BsonDocument;
import org.bson.BsonString;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.RecordingException;
import io.furrow.mission.RecordingExtent;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionCatalogTest {
    private static final String LONG = "Fräse und Striegel auf dem nördlichen Feld hinter dem großen Hügel";

    @AutoClose
    private EmbeddedMongo mongo;

    @AutoClose
    private MongoClient client;

    private MongoDatabase database;

    @BeforeEach
    void connect() {
        mongo = EmbeddedMongo.inMemory();
        client = MongoClients.create(mongo.uri());
        database = client.getDatabase(MongoAccess.DATABASE);
    }

    @Test
    void deletesAMissionByEitherOfItsNames() throws Exception {
        store("mission_weeding", 30, 10, 20);
        store("mission__x-a-2Eb", 5);
        store("mission__x-c-2Ed", 5);
        try (MissionCatalog catalog = MissionCatalog.open(mongo.uri(), MongoAccess.DATABASE)) {
            assertThat(catalog.events("weeding")).hasValue(3);
            for (String name : List.of("weeding", "a.b", "_x-c-2Ed", "nosuch")) {
                catalog.delete(name);
                assertThat(catalog.events(name)).isEmpty();
            }
            assertThat(catalog.topicNames()).isEmpty();
        }
    }

    @Test
    void listsMissionsByTheirNamesWithTheirSpans() throws Exception {
        store("mission_weeding", 30, 10, 20);
        store("mission__x-a-2Eb", 5);
        database.createCollection("mission_sowing");
        database.createCollection("markers");
        try (MissionCatalog catalog = MissionCatalog.open(mongo.uri(), MongoAccess.DATABASE)) {
            var encoded = new StoredMission("a.b", "mission__x-a-2Eb", Optional.of(new RecordingExtent(5, 5)));
            var weeding = new StoredMission("weeding", "mission_weeding", Optional.of(new RecordingExtent(10, 30)));
            assertThat(catalog.list())
                    .containsExactly(encoded, new StoredMission("sowing", "mission_sowing", Optional.empty()), weeding);
            assertThat(catalog.topicNames()).containsExactly("_x-a-2Eb", "sowing", "weeding");
            assertThat(catalog.find("weeding")).contains(weeding);
            assertThat(catalog.find("a.b")).contains(encoded);
            assertThat(catalog.find("_x-a-2Eb")).contains(encoded);
            assertThat(catalog.find("hoeing")).isEmpty();
            assertThat(List.of(catalog.has("sowing"), catalog.has("_x-a-2Eb"))).containsOnly(true);
            assertThat(List.of(catalog.has("hoeing"), catalog.has("markers"), catalog.has("")))
                    .containsOnly(false);
        }
    }

    @Test
    void readsALongNameFromTheNewestEvent() throws Exception {
        String collection = MissionCollections.nameOf(LONG);
        assertThat(collection).startsWith("mission__h-");
        String hash = collection.substring(MissionCollections.PREFIX.length());
        try (MissionCatalog catalog = MissionCatalog.open(mongo.uri(), MongoAccess.DATABASE)) {
            store(collection, 1);
            assertThat(catalog.list()).extracting(StoredMission::name).containsExactly(hash);

            database.getCollection(collection, BsonDocument.class)
                    .insertOne(new BsonDocument("_id", new BsonString("named"))
                            .append("_time", new BsonDateTime(2))
                            .append("Mission", new BsonDocument("value", new BsonString(LONG))));
            assertThat(catalog.list()).extracting(StoredMission::name).containsExactly(LONG);

            database.getCollection(collection, BsonDocument.class)
                    .insertOne(new BsonDocument("_id", new BsonString("other"))
                            .append("_time", new BsonDateTime(3))
                            .append("Mission", new BsonDocument("value", new BsonString("another"))));
            assertThat(catalog.list()).extracting(StoredMission::name).containsExactly(hash);
        }
    }

    /** Whether an index is used depends on the form of the query. */
    @Test
    void readsOneDocumentAtEachEndOfTheIndexOnEventTime() throws Exception {
        store("mission_weeding", 30, 10, 20);
        List<BsonDocument> commands = new CopyOnWriteArrayList<>();
        try (MongoClient listening = MongoAwayTest.listening(mongo.uri(), commands)) {
            MongoRecording.span(listening
                    .getDatabase(MongoAccess.DATABASE)
                    .getCollection("mission_weeding", RawBsonDocument.class));
        }
        List<BsonDocument> finds =
                commands.stream().filter(it -> it.containsKey("find")).toList();
        assertThat(finds)
                .extracting(it -> it.getDocument("sort").toJson())
                .containsExactly("{\"_time\": 1}", "{\"_time\": -1}");
        assertThat(finds)
                .allSatisfy(it -> assertThat(it.getNumber("limit").intValue()).isEqualTo(1));
    }

    @Test
    void reportsThatMongoIsUnavailable() throws Exception {
        int port = FreePort.orFree(0);
        MongoRecordings unavailable =
                new MongoRecordings("mongodb://127.0.0.1:" + port, "away", Duration.ofMillis(100));
        try (MissionCatalog catalog = new MissionCatalog(unavailable)) {
            assertThatThrownBy(() -> catalog.has("hoeing"))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageStartingWith("The list of missions cannot be read from MongoDB at 127.0.0.1:" + port)
                    .hasMessageEndingWith("Check that MongoDB runs there and answers.");
        }
    }

    private void store(String collection, long... times) throws Exception {
        for (long time : times) {
            database.getCollection(collection, RawBsonDocument.class)
                    .insertOne(new RawBsonDocument(EventDocumentCodec.write(RandomEvents.event("e" + time, time, 0))));
        }
    }
}
