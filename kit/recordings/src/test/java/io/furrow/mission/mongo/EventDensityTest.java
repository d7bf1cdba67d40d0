package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.Arrays;
import java.util.Date;
import java.util.List;
import java.util.Random;

import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import org.bson.Document;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.RecordingException;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class EventDensityTest {
    private static final long TIME = RandomEvents.TIME;

    @AutoClose
    private static EmbeddedMongo mongo;

    @AutoClose
    private static MongoClient client;

    @BeforeAll
    static void connect() {
        mongo = EmbeddedMongo.inMemory();
        client = MongoClients.create(mongo.uri());
    }

    private static MongoCollection<Document> collection(String database, String mission) {
        return client.getDatabase(database).getCollection("mission_" + mission);
    }

    private static Document at(Object time) {
        return new Document("id", "urn:x").append("_time", time);
    }

    @Test
    void countsEachEventInTheBucketOfItsTime() throws Exception {
        long seed = System.nanoTime();
        Random random = new Random(seed);
        long width = 1 + random.nextInt(400);
        long[] expected = new long[50];
        MongoCollection<Document> events = collection("counted", "hoeing");
        for (int i = 0; i < 1_000; i++) {
            long time = TIME + random.nextInt(60 * (int) width) - 5 * width;
            events.insertOne(at(new Date(time)));
            long bucket = Math.floorDiv(time - TIME, width);
            if (bucket >= 0 && bucket < expected.length) {
                expected[(int) bucket]++;
            }
        }

        try (EventDensity density = EventDensity.open(mongo.uri(), "counted")) {
            assertThat(density.count("hoeing", TIME, width, expected.length))
                    .as("seed %d", seed)
                    .contains(expected);
            assertThat(Arrays.stream(density.count("hoeing", TIME + 60 * width, width, 3)
                                    .orElseThrow())
                            .sum())
                    .isZero();
        }
    }

    @Test
    void countsOnlyDocumentsWithATime() throws Exception {
        MongoCollection<Document> events = collection("odd", "hoeing");
        events.insertMany(List.of(
                at(new Date(TIME)),
                at(TIME),
                at("2023"),
                at(null),
                at(List.of(new Date(TIME), new Date(TIME + 1))),
                new Document("id", "urn:y")));

        try (EventDensity density = EventDensity.open(mongo.uri(), "odd")) {
            assertThat(density.count("hoeing", TIME, 10, 2)).contains(new long[] {1, 0});
        }
    }

    @Test
    void returnsEmptyForAMissionThatIsNotStored() throws Exception {
        try (EventDensity density = EventDensity.open(mongo.uri(), "nothing")) {
            assertThat(density.count("sowing", TIME, 10, 2)).isEmpty();
        }
    }

    @Test
    void reportsThatMongoIsUnavailable() {
        MongoRecordings unavailable =
                new MongoRecordings("mongodb://127.0.0.1:" + FreePort.orFree(0), "away", Duration.ofMillis(100));
        try (EventDensity density = new EventDensity(unavailable)) {
            assertThatThrownBy(() -> density.count("hoeing", TIME, 10, 2))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageStartingWith("The events of mission hoeing cannot be counted at MongoDB at 127.0.0.1:")
                    .hasMessageEndingWith("Check that MongoDB runs there and answers.");
        }
    }
}
