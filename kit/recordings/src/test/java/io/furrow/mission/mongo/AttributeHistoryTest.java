package io.furrow.mission.mongo;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Date;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;

import com.fasterxml.jackson.databind.node.ObjectNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import com.mongodb.client.MongoCollection;
import org.bson.Document;
import org.bson.RawBsonDocument;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.FreePort;
import io.furrow.mission.RandomEvents;
import io.furrow.mission.RecordingException;
import io.furrow.mission.StoredEvent;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class AttributeHistoryTest {
    private static final long TIME = RandomEvents.TIME;
    private static final int PAGE = 10;

    @AutoClose
    private static EmbeddedMongo mongo;

    @AutoClose
    private static MongoClient client;

    @BeforeAll
    static void connect() {
        mongo = EmbeddedMongo.inMemory();
        client = MongoClients.create(mongo.uri());
    }

    private static MongoCollection<RawBsonDocument> collection(String database) {
        return client.getDatabase(database).getCollection("mission_hoeing", RawBsonDocument.class);
    }

    private static void store(String database, String id, long after, String attributes) throws Exception {
        ObjectNode entity = (ObjectNode)
                NgsiJson.read(("{\"id\":\"t1\",\"type\":\"Thermometer\"," + attributes + "}").getBytes(UTF_8));
        collection(database)
                .insertOne(new RawBsonDocument(EventDocumentCodec.write(new StoredEvent(
                        id, TIME + after, "t1", Map.of("fiware-service", "Farm", "ts-source", "7"), entity))));
    }

    private static List<AttributeHistory.Value> read(String database, String attribute, long from, long to)
            throws RecordingException {
        List<AttributeHistory.Value> values = new ArrayList<>();
        try (AttributeHistory history = history(database)) {
            OptionalLong since = history.read(
                    "hoeing",
                    new AttributeHistory.Range("t1", attribute, TIME + from, TIME + to),
                    Long.MAX_VALUE,
                    values::add);
            assertThat(since).hasValue(TIME + from);
        }
        return values;
    }

    private static AttributeHistory history(String database) {
        return new AttributeHistory(new MongoRecordings(mongo.uri(), database), PAGE);
    }

    /** Some events share a millisecond with others, also across pages. */
    @ParameterizedTest
    @ValueSource(ints = {0, 1, PAGE - 1, PAGE, PAGE + 1, 95})
    void readsEachValueOnceTheNewestFirst(int number) throws Exception {
        String database = "pages" + number;
        store(database, "other", 3, "\"Note\":{\"type\":\"Text\",\"value\":\"x\"}");
        for (int i = 0; i < number; i++) {
            store(database, "e" + i, i / 3, "\"Temperature\":{\"type\":\"Float\",\"value\":" + i + "}");
        }

        List<AttributeHistory.Value> values = read(database, "Temperature", 0, 1_000);
        assertThat(values)
                .extracting(AttributeHistory.Value::number)
                .doesNotHaveDuplicates()
                .hasSize(number);
        assertThat(values)
                .isSortedAccordingTo((one, other) -> Long.compare(other.time(), one.time()))
                .allMatch(value -> value.scope().equals(FiwareScope.of("farm", "/"))
                        && value.type().equals("Thermometer"));
        assertThat(read(database, "Temperature", 1, 2))
                .extracting(AttributeHistory.Value::time)
                .hasSize(Math.max(0, Math.min(3, number - 3)))
                .containsOnly(number > 3 ? new Long[] {TIME + 1} : new Long[0]);
    }

    /** A device may report a page of values in one millisecond. */
    @Test
    void passesAMillisecondWithMoreValuesThanAPage() throws Exception {
        for (int i = 0; i < 3 * PAGE; i++) {
            store("crowded", "e" + i, 5, "\"n\":{\"type\":\"Float\",\"value\":" + i + "}");
        }
        store("crowded", "older", 4, "\"n\":{\"type\":\"Float\",\"value\":-1}");

        assertThat(read("crowded", "n", 0, 10))
                .extracting(AttributeHistory.Value::number)
                .endsWith(-1.0);
    }

    @ParameterizedTest
    @ValueSource(strings = {"a.b", "$where", "_id", "_time", "%2E", "", "a$b", "\u0000", "constructor"})
    void readsAttributesOfAnyName(String name) throws Exception {
        String database = "name" + name.length() + "x" + Integer.toHexString(name.hashCode());
        String json = NgsiJson.mapper().writeValueAsString(name);
        store(database, "e1", 1, json + ":{\"type\":\"Float\",\"value\":21.5}");

        assertThat(read(database, name, 0, 10))
                .extracting(AttributeHistory.Value::number)
                .containsExactly(21.5);
    }

    @Test
    void readsNoAttributeOfItsOwnFields() throws Exception {
        store("own", "e1", 1, "\"n\":{\"type\":\"Float\",\"value\":1}");
        collection("own")
                .withDocumentClass(Document.class)
                .insertOne(new Document("id", "t1").append("_time", List.of(new Date(TIME + 2))));

        for (String name : List.of("id", "type", "_headers", "_time", "n.value", "m")) {
            assertThat(read("own", name, 0, 10)).as(name).isEmpty();
        }
    }

    @ParameterizedTest
    @ValueSource(
            strings = {
                "21.5 | 21.5",
                "\"21.5\" | 21.5",
                "\"{%27data%27: 3}\" | 3.0",
                "12345678901234567890 | 1.2345678901234567E19",
                "true | 1.0",
                "\"Running\" | NaN",
                "{\"value\": 1} | NaN",
                "[1] | NaN",
                "null | NaN"
            })
    void readsNumbersAsTheJobsDo(String row) throws Exception {
        String[] parts = row.split(" \\| ");
        String database = "kind" + Integer.toHexString(row.hashCode());
        store(
                database,
                "e1",
                1,
                "\"n\":{\"type\":\"Any\",\"value\":" + parts[0]
                        + ",\"metadata\":{\"unit\":{\"type\":\"Text\",\"value\":\"km\"}}}");

        assertThat(read(database, "n", 0, 10))
                .containsExactly(new AttributeHistory.Value(
                        TIME + 1,
                        FiwareScope.of("farm", "/"),
                        "Thermometer",
                        Double.parseDouble(parts[1]),
                        parts[0].equals("true"),
                        parts[0].equals("\"Running\"") ? "Running" : "",
                        "km"));
    }

    @Test
    void reportsSinceWhenItIsCompleteIfTheTimeIsOver() throws Exception {
        for (int i = 0; i < 3 * PAGE; i++) {
            store("long", "e" + i, i, "\"n\":{\"type\":\"Float\",\"value\":" + i + "}");
        }
        List<AttributeHistory.Value> values = new ArrayList<>();
        try (AttributeHistory history = history("long")) {
            OptionalLong since = history.read(
                    "hoeing", new AttributeHistory.Range("t1", "n", TIME, TIME + 100), System.nanoTime(), values::add);

            assertThat(since).hasValue(TIME + 2 * PAGE + 1);
        }
        assertThat(values)
                .extracting(AttributeHistory.Value::number)
                .hasSize(PAGE - 1)
                .endsWith(2 * PAGE + 1.0);
    }

    @Test
    void returnsEmptyForAMissionThatIsNotStoredAndReportsThatMongoIsUnavailable() throws Exception {
        AttributeHistory.Range range = new AttributeHistory.Range("t1", "n", TIME, TIME + 1);
        try (AttributeHistory history = history("nothing")) {
            assertThat(history.read("sowing", range, Long.MAX_VALUE, value -> {}))
                    .isEmpty();
        }
        MongoRecordings unavailable =
                new MongoRecordings("mongodb://127.0.0.1:" + FreePort.orFree(0), "away", Duration.ofMillis(100));
        try (AttributeHistory history = new AttributeHistory(unavailable, PAGE)) {
            assertThatThrownBy(() -> history.read("hoeing", range, Long.MAX_VALUE, value -> {}))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageStartingWith("The values of mission hoeing cannot be read from MongoDB at 127.0.0.1:");
        }
    }
}
