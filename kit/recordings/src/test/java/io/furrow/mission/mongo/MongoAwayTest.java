package io.furrow.mission.mongo;

import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.time.InstantSource;
import java.time.ZoneOffset;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.atomic.AtomicReference;

import com.mongodb.ConnectionString;
import com.mongodb.MongoClientSettings;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import com.mongodb.event.CommandListener;
import com.mongodb.event.CommandStartedEvent;
import org.bson.BsonDocument;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.Cursor;
import io.furrow.mission.EventPage;
import io.furrow.mission.PageLimits;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.Recording;
import io.furrow.mission.RecordingDeletedException;
import io.furrow.mission.RecordingException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class MongoAwayTest {
    private static final PageLimits TWO = new PageLimits(2, 10_000);

    @Test
    void reportsThatMongoIsUnavailableAndContinuesWhenItIsBack(@TempDir Path directory) throws Exception {
        int port = FreePort.orFree(0);
        MongoRecordings recordings = new MongoRecordings(
                "mongodb://u:secret@127.0.0.1:" + port, MongoAccess.DATABASE, Duration.ofMillis(300));
        MongoRecordings reachable = new MongoRecordings("mongodb://127.0.0.1:" + port, MongoAccess.DATABASE);
        MongoRecordings shortTimeout =
                new MongoRecordings("mongodb://127.0.0.1:" + port, MongoAccess.DATABASE, Duration.ofMillis(300));
        assertThatThrownBy(() -> shortTimeout.open("hoeing"))
                .isInstanceOf(RecordingException.class)
                .hasMessageStartingWith("Mission hoeing cannot be read from MongoDB at 127.0.0.1:" + port)
                .hasMessageEndingWith("Check that MongoDB runs there and answers.");
        assertThat(recordings.toString()).doesNotContain("secret");

        EmbeddedMongo first = EmbeddedMongo.start(directory, port);
        store("mongodb://127.0.0.1:" + port);
        try (Recording recording = reachable.open("hoeing").orElseThrow()) {
            EventPage eventPage = recording.read(Cursor.START, TWO);
            first.close();

            assertThatThrownBy(() -> readTwice(recording, eventPage.next()))
                    .isInstanceOf(RecordingException.class)
                    .isNotInstanceOf(RecordingDeletedException.class);

            try (EmbeddedMongo second = EmbeddedMongo.start(directory, port)) {
                await().ignoreExceptionsInstanceOf(RecordingException.class)
                        .until(() ->
                                recording.read(eventPage.next(), TWO).events().size() == 2);
                List<String> rest = new ArrayList<>();
                EventPage next = eventPage;
                do {
                    next = recording.read(next.next(), TWO);
                    next.events().forEach(event -> rest.add(event.id()));
                } while (!next.last());
                assertThat(rest).containsExactly("c", "d", "e");
                assertThat(second.uri()).endsWith(":" + port);
            }
        }
    }

    /** The open query may still return a page. */
    private static void readTwice(Recording recording, Cursor next) throws RecordingException {
        recording.read(next, TWO);
        recording.read(Cursor.before(0), TWO);
    }

    /** Whether an index is used depends on the form of the query, which must match the index of the missions. */
    @Test
    void queriesByTheKeyOfAnIndexOfIngest() throws Exception {
        List<BsonDocument> commands = new ArrayList<>();
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory();
                MongoClient client = listening(mongo.uri(), commands)) {
            MissionCollections collections =
                    new MissionCollections(client, Retention.FOR_EVER, java.time.Clock.systemUTC());
            MongoCollection<RawBsonDocument> collection = collections.prepared("mission_hoeing");
            collection.insertOne(new RawBsonDocument(EventDocumentCodec.write(RandomEvents.event("a", 1, 0))));
            BsonDocument key = commands.stream()
                    .filter(command -> command.containsKey("createIndexes"))
                    .map(command ->
                            command.getArray("indexes").get(0).asDocument().getDocument("key"))
                    .findFirst()
                    .orElseThrow();
            EventPage eventPage;
            try (MongoRecording recording = new MongoRecording(
                    "hoeing",
                    SharedMongoClient.of(mongo.uri(), MongoAccess.SELECTION_TIMEOUT),
                    collection,
                    "here",
                    OrderedDocumentReader.Sizes.DEFAULT)) {
                eventPage = recording.read(Cursor.before(0), TWO);
            }

            BsonDocument find = commands.get(commands.size() - 1);
            assertThat(eventPage.events()).hasSize(1);
            assertThat(key).isEqualTo(BsonDocument.parse("{_time: 1}"));
            assertThat(find.getDocument("sort")).isEqualTo(key);
            assertThat(find.getDocument("filter"))
                    .isEqualTo(BsonDocument.parse(
                            "{$and: [{_time: {$gte: {$date: {$numberLong: '0'}}}}, {_time: {$not: {$type: 4}}}]}"));
            assertThat(find.getNumber("limit").intValue()).isEqualTo(2_000);
            assertThat(find.getNumber("batchSize").intValue()).isEqualTo(500);
        }
    }

    /** The next write recreates the collection. */
    @Test
    void createsIndexesAgainAfterACollectionMayHaveBeenDropped() throws Exception {
        List<BsonDocument> commands = new ArrayList<>();
        AtomicReference<Instant> now = new AtomicReference<>(Instant.ofEpochSecond(1_700_000_000));
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory();
                MongoClient client = listening(mongo.uri(), commands)) {
            InstantSource clock = now::get;
            var collections = new MissionCollections(client, Retention.FOR_EVER, clock.withZone(ZoneOffset.UTC));
            collections.prepared("mission_hoeing");
            collections.prepared("mission_hoeing").drop();
            assertThat(createdIndexes(commands)).isEqualTo(2);

            now.set(now.get().plusSeconds(61));
            collections.prepared("mission_hoeing");
            assertThat(createdIndexes(commands)).isEqualTo(4);
        }
    }

    private static long createdIndexes(List<BsonDocument> commands) {
        return commands.stream()
                .filter(command -> command.containsKey("createIndexes"))
                .count();
    }

    /** Returns a client that adds its commands to a list. */
    static MongoClient listening(String uri, List<BsonDocument> commands) {
        return MongoClients.create(MongoClientSettings.builder()
                .applyConnectionString(new ConnectionString(uri))
                .addCommandListener(new CommandListener() {
                    @Override
                    public void commandStarted(CommandStartedEvent event) {
                        commands.add(event.getCommand().clone());
                    }
                })
                .build());
    }

    private static void store(String uri) throws Exception {
        try (MongoClient client = MongoClients.create(uri)) {
            MongoCollection<RawBsonDocument> collection =
                    client.getDatabase(MongoAccess.DATABASE).getCollection("mission_hoeing", RawBsonDocument.class);
            for (String id : List.of("e", "d", "c", "b", "a")) {
                collection.insertOne(
                        new RawBsonDocument(EventDocumentCodec.write(RandomEvents.event(id, id.charAt(0), 0))));
            }
        }
    }
}
