package io.furrow.control.rest;

import java.io.IOException;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.util.Date;
import java.util.List;
import java.util.Properties;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.mongodb.client.MongoClient;
import com.mongodb.client.MongoClients;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.bson.Document;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.Readiness;
import io.furrow.model.control.RecordedMission;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.ISO_8859_1;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class TimelineIT {
    private static final long TIME = 1_700_000_000_000L;
    private static final String TIMELINE = "/api/recordings/hoeing/timeline";

    private RunningApi running;
    private EmbeddedMongo mongo;
    private RestApi api;
    private ApiClient client;

    @BeforeEach
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        mongo = EmbeddedMongo.inMemory();
        try (MongoClient documents = MongoClients.create(mongo.uri())) {
            documents
                    .getDatabase("persistence")
                    .getCollection("mission_hoeing")
                    .insertMany(List.of(event(0), event(1), event(2_500), event(9_999)));
        }
        Properties producing = new Properties();
        producing.putAll(running.settings().client());
        try (var producer = KafkaClients.producer(producing)) {
            for (String mission : List.of("hoeing", "deleted")) {
                producer.send(new ProducerRecord<>(
                        Topics.RECORDINGS, mission, new RecordedMission(mission, TIME, TIME + 9_999, 5).toBytes()));
            }
        }
        api = RestApi.start(
                running.settings().with(ReplaySettings.DEFAULT.withMongo(mongo.uri())),
                RestSettings.on(0),
                new Readiness(Clock.systemUTC()));
        client = new ApiClient(api.uri(), null);
        await().until(api::isReady);
    }

    private static Document event(long after) {
        return new Document("id", "urn:x").append("_time", new Date(TIME + after));
    }

    @AfterEach
    void stop() {
        api.close();
        mongo.close();
        running.close();
    }

    private JsonNode counts(String query) throws Exception {
        await().until(() -> client.get(TIMELINE + query).path("complete").asBoolean());
        return client.get(TIMELINE + query);
    }

    @Test
    void countsTheEventsOfAMissionByBucket() throws Exception {
        JsonNode all = counts("?buckets=10");
        assertThat(all.path("from").asLong()).isEqualTo(TIME);
        assertThat(all.path("width").asLong()).isEqualTo(1_000);
        assertThat(all.path("counts").toString()).isEqualTo("[2,0,1,0,0,0,0,0,0,1]");
        assertThat(all.path("first").asLong()).isEqualTo(TIME);
        assertThat(all.path("last").asLong()).isEqualTo(TIME + 9_999);

        JsonNode part = counts("?buckets=3&from=2023-11-14T22:13:22Z&to=" + (TIME + 3_500));
        assertThat(part.path("from").asLong()).isEqualTo(TIME + 2_000);
        assertThat(part.path("counts").toString()).isEqualTo("[0,1,0]");
    }

    @Test
    void rejectsARangeOutsideOfTheMission() throws Exception {
        assertRejected("/api/recordings/sowing/timeline", "404 unknown-mission");
        assertRejected("/api/recordings/deleted/timeline", "404 unknown-mission");
        assertRejected(TIMELINE + "?buckets=0", "400 wrong-member");
        assertRejected(TIMELINE + "?buckets=1001", "400 wrong-member");
        assertRejected(TIMELINE + "?from=noon", "400 wrong-member");
        assertRejected(TIMELINE + "?from=0&to=144115188076800000&buckets=1", "400 wrong-member");
        assertRejected(TIMELINE + "?from=0&to=999999999999999&buckets=1", "400 wrong-member");
        assertRejected(TIMELINE + "?from=" + (TIME + 10_000), "400 wrong-member");
        assertThat(running.client().error("GET", TIMELINE, null))
                .as("without --mongo")
                .isEqualTo("501 no-mongodb");

        mongo.close();
        assertRejected(TIMELINE + "?buckets=7", "503 mongodb-away");
    }

    @Test
    void servesTheHistoryOfADevice() throws Exception {
        String lines = IntStream.range(0, 100)
                .mapToObj(i ->
                        "{\"id\":\"h%d\",\"time\":%d,\"headers\":{\"fiware-service\":\"farm\"},\"entity\":{\"id\":\"t\",\"type\":\"T\",\"a.b\":{\"type\":\"Number\",\"value\":%d}}}\n"
                                .formatted(i, TIME + i, i == 42 ? 999 : i % 3))
                .collect(Collectors.joining());
        load("hoeing", lines);
        String path = "/api/devices/t/history?service=farm&servicePath=/&attribute=";
        String period = "&from=2023-11-14T22:13:20Z&to=" + (TIME + 100);

        JsonNode history = client.get(path + "a.b&points=10" + period);
        assertThat(history.path("values").asInt()).isEqualTo(100);
        assertThat(history.path("points").size()).isLessThanOrEqualTo(10);
        assertThat(history.findValuesAsText("value")).contains("999.0");
        assertThat(client.get("/api/v1/devices/t/history?service=farm&attribute=a.b&points=10" + period)
                        .at("/points/0/time")
                        .asText())
                .isEqualTo("2023-11-14T22:13:20Z");
        assertThat(client.get(path + "$where" + period).path("kind").asText()).isEqualTo("none");
        assertThat(client.get(path.replace("/t/", "/nosuch/") + "a.b" + period).path("points"))
                .isEmpty();

        assertRejected(path + "a.b&mission=nosuch", "404 unknown-mission");
        assertRejected(path + "a.b&points=9", "400 wrong-member");
        assertRejected(path + "a.b&from=2&to=1", "400 wrong-member");
        assertRejected(path + "x".repeat(257), "400 wrong-member");
        assertRejected("/api/devices/t/history", "400 missing-member");
        assertThat(running.client().error("GET", path + "a.b", null))
                .as("without --mongo")
                .isEqualTo("501 no-mongodb");
    }

    @Test
    void deletesAMissionWithItsMarkersUnlessItIsInUse() throws Exception {
        String path = "/api/recordings/hoeing";
        client.send("POST", "/api/missions/hoeing/markers", "{\"time\":5,\"note\":\"n\"}");
        client.send("POST", "/api/missions/sowing/markers", "{\"time\":5,\"note\":\"n\"}");
        counts("?buckets=10");
        JsonNode dry = client.ask("DELETE", path + "?dryRun=true", null);
        assertThat(dry.path("events").asInt()).isEqualTo(4);
        assertThat(dry.path("markers").asInt()).isEqualTo(1);
        assertThat(client.get("/api/missions/hoeing/markers")).hasSize(1);

        client.send("POST", "/api/domains", "{\"domain\":\"west\"}");
        client.send("POST", "/api/missions/hoeing/start", "{\"domain\":\"west\",\"devices\":[\"urn:x\"]}");
        await().until(() -> client.get("/api/missions/hoeing?wait=running&wait=starting")
                .at("/status/state")
                .asText()
                .matches("starting|running"));
        assertThat(client.error("DELETE", path, null)).isEqualTo("409 mission-running");
        client.send("POST", "/api/missions/hoeing/stop", null);
        await().until(() ->
                client.get("/api/missions/hoeing").at("/status/state").asText().equals("stopped"));
        String replay = client.ask("POST", "/api/replays", "{\"mission\":\"hoeing\"}")
                .path("replay")
                .asText();
        assertThat(client.error("DELETE", path, null)).isEqualTo("409 replay-running");
        byte[] stopped = new ReplayStatus(1, ReplayStatus.State.STOPPED, null, false, null).toBytes();
        running.write(Topics.REPLAYS_STATUS, replay, stopped);
        await().until(() -> client.status("DELETE", path + "?dryRun=true", null) == 200);

        assertThat(client.ask("DELETE", path, null).toString())
                .isEqualTo(
                        "{\"type\":\"response\",\"status\":\"purged\",\"mission\":\"hoeing\",\"events\":4,\"markers\":1}");
        assertThat(client.get("/api/missions/hoeing/markers")).isEmpty();
        assertThat(client.get("/api/missions/sowing/markers")).hasSize(1);
        assertRejected("/api/recordings/hoeing/timeline", "404 unknown-mission");
        assertThat(client.error("DELETE", path, null)).isEqualTo("404 unknown-mission");
        await().until(() -> client.get("/api/audit?mission=hoeing")
                .findValuesAsText("result")
                .contains("purged"));
    }

    @Test
    void exportsAndImportsAMissionUnchanged() throws Exception {
        String lines = IntStream.range(0, 3_000)
                .mapToObj(i ->
                        "{\"id\":\"e%d\",\"time\":%d,\"headers\":{\"service\":\"farm\"},\"entity\":{\"id\":\"t\",\"type\":\"T\",\"n\":1.50}}\n"
                                .formatted(i, TIME + i))
                .collect(Collectors.joining());
        assertThat(load("sown", lines).path("events").asInt()).isEqualTo(3_000);
        byte[] exported =
                client.send("GET", "/api/recordings/sown/events", null).body();
        assertThat(new String(exported, UTF_8)).isEqualTo(lines);
        load("copy", lines);
        load("copy", lines);
        assertThat(client.send("GET", "/api/v1/recordings/copy/events?format=jsonl", null)
                        .body())
                .isEqualTo(exported);
        HttpResponse<byte[]> mcap = client.send("GET", "/api/recordings/copy/events?format=mcap", null);
        assertThat(new String(mcap.body(), 0, 6, ISO_8859_1)).isEqualTo("\u0089MCAP0");

        assertThat(load("copy", lines + "{\"id\":\n").path("error").asText()).isEqualTo("not-an-event");
        assertThat(load("a.b", lines).path("error").asText()).isEqualTo("illegal-name");
        assertThat(client.error("GET", "/api/recordings/nosuch/events", null)).isEqualTo("404 unknown-mission");
        assertThat(client.error("GET", "/api/recordings/copy/events?format=geojson", null))
                .isEqualTo("400 wrong-member");
        await().until(() -> client.get("/api/audit?mission=copy").findValuesAsText("result").stream()
                .sorted()
                .toList()
                .equals(List.of("error", "imported", "imported")));
    }

    private JsonNode load(String mission, String lines) throws Exception {
        return client.ask(
                "POST", "/api/recordings/" + mission + "/events", lines, "Content-Type", RecordedEventsResource.LINES);
    }

    /** Else a client would take what it has for all. */
    @Test
    void breaksTheConnectionIfAnExportFails() throws Exception {
        String lines = IntStream.range(0, 3_000)
                .mapToObj(i ->
                        "{\"id\":\"e%d\",\"time\":%d,\"headers\":{},\"entity\":{\"id\":\"t\",\"type\":\"T\",\"text\":\"%s\"}}\n"
                                .formatted(i, TIME + i, "x".repeat(200)))
                .collect(Collectors.joining());
        load("broken", lines);
        load("whole", lines);
        try (MongoClient documents = MongoClients.create(mongo.uri())) {
            documents
                    .getDatabase("persistence")
                    .getCollection("mission_broken")
                    .insertOne(new Document("_time", new Date(TIME + 9_999)));
        }

        String path = "/api/recordings/broken/events";
        for (String query : List.of("", "?format=jsonl")) { // a failure occupies no transfer
            assertThatThrownBy(() -> client.send("GET", path + query, null)).isInstanceOf(IOException.class);
            assertThatThrownBy(() -> client.send("GET", path + query, null, "Accept-Encoding", "gzip"))
                    .isInstanceOf(IOException.class);
        }
        String lastChunk = "\r\n0\r\n\r\n";
        assertThat(client.raw("/api/recordings/whole/events", "127.0.0.1"))
                .contains("chunked", "\"e2999\"")
                .endsWith(lastChunk);
        assertThat(client.raw(path, "127.0.0.1"))
                .startsWith("HTTP/1.1 200")
                .contains("chunked", "\"e1\"")
                .doesNotContain(lastChunk);
    }

    private void assertRejected(String path, String error) throws Exception {
        await().untilAsserted(() -> assertThat(client.error("GET", path, null)).isEqualTo(error));
    }
}
