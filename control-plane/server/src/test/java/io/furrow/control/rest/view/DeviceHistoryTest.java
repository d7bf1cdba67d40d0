package io.furrow.control.rest.view;

import java.time.Duration;
import java.util.Date;

import com.fasterxml.jackson.databind.JsonNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.bson.Document;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.control.rest.access.ProblemException;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.mongo.AttributeHistory;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DeviceHistoryTest {
    private static final long TIME = 1_700_000_000_000L;
    private static final FiwareScope SCOPE = FiwareScope.of("farm", "/");
    private static final Duration LIMIT = Duration.ofMinutes(1);

    @AutoClose
    private static EmbeddedMongo mongo;

    @AutoClose
    private static MongoClient client;

    private final StateView view = new StateView();

    @BeforeAll
    static void connect() {
        mongo = EmbeddedMongo.inMemory();
        client = MongoClients.create(mongo.uri());
    }

    @BeforeEach
    void clear() {
        client.getDatabase("persistence").drop();
        view.clear();
        view.complete();
    }

    private void hasMission(String mission, long first, long last) {
        view.put(Topics.RECORDINGS, mission, new RecordedMission(mission, TIME + first, TIME + last, 5).toBytes());
    }

    private static void stores(String mission, long after, Object value, String unit) {
        stores(mission, after, value, unit, "Robot", "farm");
    }

    private static void stores(String mission, long after, Object value, String unit, String type, String service) {
        Document speed =
                new Document("value", value).append("metadata", new Document("unitCode", new Document("value", unit)));
        client.getDatabase("persistence")
                .getCollection("mission_" + mission)
                .insertOne(new Document("id", "r1")
                        .append("type", type)
                        .append("_time", new Date(TIME + after))
                        .append("_headers", new Document("fiware-service", service))
                        .append("speed", speed));
    }

    private JsonNode read(long from, long to, String mission, int points) {
        return read(from, to, mission, points, LIMIT);
    }

    private JsonNode read(long from, long to, String mission, int points, Duration limit) {
        try (DeviceHistory history =
                new DeviceHistory(view, AttributeHistory.open(mongo.uri(), "persistence"), limit)) {
            return history.read(new DeviceHistory.Request(
                    SCOPE,
                    "ROBOT"::equalsIgnoreCase,
                    new AttributeHistory.Range("r1", "speed", TIME + from, TIME + to),
                    mission,
                    points));
        }
    }

    @Test
    void returnsTheChangesOfAText() {
        hasMission("weeding", 0, 5_000);
        Object[] states = {"idle", "Running", "Running", 7, "idle"};
        for (int i = 0; i < states.length; i++) {
            stores("weeding", i * 1_000, i == 3 ? new Document("a", 7) : states[i], "");
        }
        JsonNode history = read(0, 10_000, null, 10);
        assertThat(history.path("kind").asText()).isEqualTo("text");
        assertThat(history.path("values").asInt()).isEqualTo(4);
        assertThat(history.path("skipped").asInt()).isEqualTo(1);
        assertThat(history.path("points")).isEmpty();
        assertThat(history.path("changes"))
                .extracting(each -> each.path("time").asLong() - TIME + " "
                        + each.path("value").asText())
                .containsExactly("0 idle", "1000 Running", "4000 idle");
    }

    @Test
    void returnsTheNewestChangesOfAText() {
        hasMission("weeding", 0, 1_000);
        for (int i = 0; i < 502; i++) {
            stores("weeding", i, "s" + i, "");
        }
        JsonNode history = read(0, 10_000, null, 10);
        assertThat(history.path("changes")).hasSize(500);
        assertThat(history.at("/changes/0/value").asText()).isEqualTo("s2");
        assertThat(history.path("since").asLong()).isEqualTo(TIME + 2);
    }

    @Test
    void readsAllMissionsOfThePeriod() {
        hasMission("hoeing", 0, 1_000);
        hasMission("sowing", 500_000, 900_000);
        hasMission("mowing", 2_000_000, 3_000_000);
        stores("hoeing", 0, 1.5, "MTS");
        stores("hoeing", 1_000, 2, "MTS");
        stores("sowing", 500_000, "0.5", "MTS");
        stores("mowing", 2_000_000, 9, "MTS");

        assertThat(read(-1_000, 1_000_000, null, 2_000).toString())
                .isEqualTo("""
                {"device":"r1","attribute":"speed","from":%d,"to":%d,"since":%3$d,"kind":"number","unit":"MTS","values":3,"skipped":0,"width":0,\
                "missions":["sowing","hoeing"],"points":[{"time":%3$d,"value":1.5},{"time":%4$d,"value":2.0},{"time":%5$d,"value":0.5}]}\
                """.formatted(TIME - 1_000, TIME + 1_000_000, TIME, TIME + 1_000, TIME + 500_000));
        assertThat(read(0, 1_000_000, "sowing", 2_000).findValuesAsText("value"))
                .containsExactly("0.5");
        assertThatThrownBy(() -> read(0, 1, "seeding", 10))
                .isInstanceOf(ProblemException.class)
                .hasMessageContaining("mission 'seeding' is not recorded");
    }

    @Test
    void answersWithoutPointsIfThereAreNoNumbers() {
        hasMission("hoeing", 0, 1_000);
        assertThat(read(0, 1_000, null, 10).path("kind").asText()).isEqualTo("none");
        stores("hoeing", 10, new Document("a", 1), "");
        stores("hoeing", 11, 5, "", "Camera", "farm");
        stores("hoeing", 12, 5, "", "Robot", "other");

        JsonNode text = read(0, 1_000, null, 10);
        assertThat(text.path("kind").asText()).isEqualTo("other");
        assertThat(text.path("skipped").asInt()).isEqualTo(1);
        assertThat(text.path("points")).isEmpty();
        JsonNode before = read(-9_000_000, -8_000_000, null, 10);
        assertThat(before.path("kind").asText()).isEqualTo("none");
        assertThat(before.path("since")).isEqualTo(before.path("to"));
    }

    @Test
    void marksFlagsAndSkipsValuesInAnotherUnitThanTheNewest() {
        hasMission("hoeing", 0, 1_000);
        stores("hoeing", 1, true, "");
        stores("hoeing", 2, false, "");
        assertThat(read(0, 1_000, null, 10).path("kind").asText()).isEqualTo("boolean");
        stores("hoeing", 3, 36, "KMH");
        stores("hoeing", 4, 10, "MTS");

        JsonNode mixed = read(0, 1_000, null, 10);
        assertThat(mixed.path("kind").asText()).isEqualTo("number");
        assertThat(mixed.path("unit").asText()).isEqualTo("MTS");
        assertThat(mixed.path("skipped").asInt()).isEqualTo(3);
        assertThat(mixed.findValuesAsText("value")).containsExactly("10.0");
    }

    @Test
    void thinsManyValuesAndRetainsThePeak() {
        hasMission("hoeing", 0, 1_000);
        for (int i = 0; i < 500; i++) {
            stores("hoeing", i, i == 333 ? 99 : i % 7, "MTS");
        }

        JsonNode thinned = read(0, 500, null, 20);
        assertThat(thinned.path("values").asInt()).isEqualTo(500);
        assertThat(thinned.path("width").asInt()).isEqualTo(56);
        assertThat(thinned.path("points").size()).isLessThanOrEqualTo(20);
        assertThat(thinned.findValuesAsText("value")).contains("99.0");
    }

    @Test
    void reportsSinceWhenNothingIsMissingIfTheTimeIsOver() {
        hasMission("hoeing", 0, 1_000);
        hasMission("sowing", 500_000, 900_000);
        stores("hoeing", 0, 1, "MTS");
        stores("sowing", 500_000, 2, "MTS");

        JsonNode late = read(0, 2_000_000, null, 10, Duration.ofNanos(-1));
        assertThat(late.path("since").asLong()).isEqualTo(TIME + 900_000 + 120_000);
        assertThat(late.path("missions")).isEmpty();
    }

    @Test
    void answersThatMongoIsAway() {
        hasMission("hoeing", 0, 1_000);
        String away = "mongodb://127.0.0.1:" + FreePort.orFree(0) + "/?serverSelectionTimeoutMS=200";
        try (DeviceHistory history = new DeviceHistory(view, AttributeHistory.open(away, "persistence"), LIMIT)) {
            DeviceHistory.Request request = new DeviceHistory.Request(
                    SCOPE, type -> true, new AttributeHistory.Range("r1", "speed", TIME, TIME + 1), null, 10);

            // a failure occupies no permit
            for (int i = 0; i < 6; i++) {
                assertThatThrownBy(() -> history.read(request))
                        .isInstanceOf(ProblemException.class)
                        .hasMessageContaining("The values of mission hoeing cannot be read from MongoDB at 127.0.0.1:");
            }
        }
    }
}
