package io.furrow.mission.marker;

import java.io.ByteArrayOutputStream;
import java.time.Duration;
import java.util.List;

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
import io.furrow.mission.mongo.MongoRecordings;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MarkersTest {
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

    @Test
    void rejectsControlCharactersOfTerminals() {
        try (Markers markers = Markers.open(mongo.uri(), "refused")) {
            assertThatThrownBy(() -> markers.add(new Marker("e", "hoeing", TIME, "\u001b[2J", "Ada", TIME)))
                    .isInstanceOf(RejectedMarkerException.class)
                    .hasMessageContaining("control characters");
        }
    }

    @Test
    void listsTheMarkersOfAMissionByTimeUntilTheyAreRemoved() throws Exception {
        try (Markers markers = Markers.open(mongo.uri(), "listed")) {
            Marker late = new Marker("l", "hoeing", TIME + 2, "stops", "Ada", TIME + 9);
            Marker second = new Marker("b", "hoeing", TIME + 1, "turns\n\uD83D\uDE9C", "", TIME + 9);
            Marker first = new Marker("a", "hoeing", TIME + 1, "turns", "Ada", TIME + 9);
            Marker other = new Marker("o", "weeding", TIME, "starts", "Ada", TIME + 9);
            for (Marker marker : List.of(late, second, other, first)) {
                markers.add(marker);
            }

            assertThat(markers.list("hoeing")).containsExactly(first, second, late);
            assertThat(markers.list("hoeing", TIME, TIME + 2)).containsExactly(first, second);
            assertThat(markers.list("weeding")).containsExactly(other);
            assertThat(markers.list("sowing")).isEmpty();

            assertThat(markers.remove("weeding", "a")).isFalse();
            assertThat(markers.remove("hoeing", "a")).isTrue();
            assertThat(markers.remove("hoeing", "a")).isFalse();
            assertThat(markers.list("hoeing")).containsExactly(second, late);
        }
    }

    @Test
    void storesMarkersInTheirOwnCollectionWithAnIndexOnMissionAndTime() throws Exception {
        try (Markers markers = Markers.open(mongo.uri(), "beside")) {
            markers.add(new Marker("a", "a.b", TIME, "turns", "Ada", TIME + 1));
        }

        MongoCollection<Document> stored = client.getDatabase("beside").getCollection("markers");
        assertThat(stored.find().first().toJson()).isEqualTo("""
                {"_id": "a", "mission": "_x-a-2Eb", "time": {"$date": "2023-11-14T22:13:20Z"}, "note": "turns", \
                "author": "Ada", "created": {"$date": "2023-11-14T22:13:20.001Z"}}""");
        assertThat(stored.listIndexes())
                .extracting(index -> index.get("key", Document.class).toJson())
                .contains("{\"mission\": 1, \"time\": 1}");
    }

    /** Recordings are opened by both names, too. */
    @Test
    void findsAMissionByItsEncodedName() throws Exception {
        client.getDatabase("named").createCollection("mission__x-a-2Eb");
        try (Markers markers = Markers.open(mongo.uri(), "named")) {
            markers.add(new Marker("a", "a.b", TIME, "turns", "Ada", TIME));
            markers.add(new Marker("b", "_x-a-2Eb", TIME, "stops", "Ada", TIME));

            assertThat(markers.list("a.b")).extracting(Marker::id).containsExactly("a", "b");
            assertThat(markers.list("_x-a-2Eb")).extracting(Marker::id).containsExactly("a", "b");
            assertThat(markers.list("_x-a-2Eb")).extracting(Marker::mission).containsOnly("_x-a-2Eb");
        }
    }

    @Test
    void storesADuplicateOnceAndRejectsAnotherMarkerOfItsId() throws Exception {
        try (Markers markers = Markers.open(mongo.uri(), "again")) {
            Marker marker = new Marker("a", "hoeing", TIME, "turns", "Ada", TIME);
            markers.add(marker);
            markers.add(marker);

            assertThat(markers.list("hoeing")).containsExactly(marker);
            assertRejected(
                    markers,
                    new Marker("a", "hoeing", TIME, "stops", "Ada", TIME),
                    "There is another marker of id a; write a new id, or remove that marker first");
            assertRejected(markers, new Marker("a", "weeding", TIME, "turns", "Ada", TIME), "There is another marker");
        }
    }

    @Test
    void rejectsMarkersAboveTheMaximum() throws Exception {
        try (Markers markers = new Markers(new MongoRecordings(mongo.uri(), "full"), 3)) {
            for (String id : List.of("a", "b", "c")) {
                markers.add(new Marker(id, "hoeing", TIME, "turns", "", TIME));
            }
            Marker fourth = new Marker("d", "hoeing", TIME, "turns", "", TIME);

            assertRejected(markers, fourth, "Mission hoeing has 3 markers, and no more are stored; remove some first");
            assertThat(markers.list("hoeing")).hasSize(3);
            markers.add(new Marker("a", "hoeing", TIME, "turns", "", TIME));
            markers.add(new Marker("e", "weeding", TIME, "turns", "", TIME));
            markers.remove("hoeing", "a");
            markers.add(fourth);
            assertThat(markers.list("hoeing")).extracting(Marker::id).containsExactly("b", "c", "d");
        }
    }

    @Test
    void rejectsInvalidMarkers() throws Exception {
        try (Markers markers = Markers.open(mongo.uri(), "refused")) {
            assertRejected(markers, note(null), "The note of the marker is missing or blank; write what");
            assertRejected(markers, note(" \n"), "The note of the marker is missing or blank");
            assertRejected(
                    markers,
                    note("\uD83D\uDE9C".repeat(1_001)),
                    "The note of the marker has 1,001 characters, at most 1,000 are stored; write what");
            assertRejected(markers, note("\uD83D"), "The note of the marker holds half a character");
            assertRejected(markers, new Marker("", "m", TIME, "n", "", TIME), "The id of the marker is missing");
            assertRejected(markers, new Marker("a", "", TIME, "n", "", TIME), "The mission of the marker is missing");
            assertRejected(markers, new Marker("a", "m", TIME, "n", null, TIME), "The author of the marker is missing");
            assertRejected(
                    markers,
                    new Marker("a", "m", -1, "n", "", TIME),
                    "The time -1 of the marker is not between 1970 and 9999; write milliseconds since 1970");
            assertRejected(
                    markers, new Marker("a", "m", TIME, "n", "", Long.MAX_VALUE), "The created 9223372036854775807 of");
            assertThat(markers.list("m")).isEmpty();

            markers.add(note("\uD83D\uDE9C".repeat(1_000)));
            assertThat(markers.list("m")).hasSize(1);
        }
    }

    @Test
    void reportsThatMongoIsUnavailable() throws Exception {
        int port = FreePort.orFree(0);
        MongoRecordings unavailable =
                new MongoRecordings("mongodb://127.0.0.1:" + port, "away", Duration.ofMillis(100));
        try (Markers markers = new Markers(unavailable, 3)) {
            assertThatThrownBy(() -> markers.list("hoeing"))
                    .isInstanceOf(RecordingException.class)
                    .hasMessageStartingWith(
                            "The markers of mission hoeing cannot be reached at MongoDB at 127.0.0.1:" + port)
                    .hasMessageEndingWith("Check that MongoDB runs there and answers.");
        }
    }

    @Test
    void writesOneLinePerMarker() throws Exception {
        ByteArrayOutputStream out = new ByteArrayOutputStream();

        MarkerFile.write(List.of(new Marker("a", "hoeing", TIME, "turns", "Ada", TIME + 1)), out);

        assertThat(out.toString(UTF_8)).isEqualTo("""
                {"id":"a","mission":"hoeing","time":1700000000000,"note":"turns","author":"Ada",\
                "created":1700000000001}
                """);
        assertThat(MarkerFile.beside("/x/hoeing.ndjson.gz")).isEqualTo("/x/hoeing.markers.jsonl");
        assertThat(MarkerFile.beside("s3://y/a.b")).isEqualTo("s3://y/a.b.markers.jsonl");
    }

    private static Marker note(String note) {
        return new Marker("a", "m", TIME, note, "", TIME);
    }

    private static void assertRejected(Markers markers, Marker marker, String message) {
        assertThatThrownBy(() -> markers.add(marker))
                .isInstanceOf(RejectedMarkerException.class)
                .hasMessageStartingWith(message);
    }
}
