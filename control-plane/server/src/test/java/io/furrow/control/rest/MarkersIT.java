package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.replay.ReplaySettings;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.kafka.Readiness;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class MarkersIT {
    private static final String MARKERS = "/api/missions/weeding/markers";

    private RunningApi running;
    private EmbeddedMongo mongo;
    private RestApi api;
    private ApiClient olga;

    @BeforeEach
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        mongo = EmbeddedMongo.inMemory();
        Path tokens = Files.writeString(directory.resolve("tokens"), "olga token-of-an-operator operator\n");
        api = RestApi.start(
                running.settings().with(ReplaySettings.DEFAULT.withMongo(mongo.uri())),
                RestSettings.on(0).withTokens(tokens),
                new Readiness(Clock.systemUTC()));
        olga = new ApiClient(api.uri(), "token-of-an-operator");
        await().until(api::isReady);
    }

    @AfterEach
    void stop() {
        api.close();
        mongo.close();
        running.close();
    }

    private HttpResponse<byte[]> add(String body, String key) throws Exception {
        return olga.send("POST", MARKERS, body, "Idempotency-Key", key);
    }

    @Test
    void storesMarkersOfAMission() throws Exception {
        HttpResponse<byte[]> created =
                add("{\"time\":\"2026-03-01T08:00:00Z\",\"note\":\"The robot turns too early\"}", "k-1");
        assertThat(created.statusCode()).isEqualTo(201);
        JsonNode marker = olga.json(created);
        String id = marker.path("id").asText();
        assertThat(created.headers().firstValue("Location")).contains("markers/" + id);
        assertThat(marker.path("author").asText()).isEqualTo("olga");
        assertThat(marker.path("time").asLong()).isEqualTo(1_772_352_000_000L);
        assertThat(add("{\"time\":1700000000000,\"note\":\"before\"}", "k-2").statusCode())
                .isEqualTo(201);

        HttpResponse<byte[]> repeated = add("{\"time\":1772352000000,\"note\":\"The robot turns too early\"}", "k-1");
        assertThat(olga.json(repeated)).as("a repeated request").isEqualTo(marker);
        assertThat(olga.get(MARKERS).findValuesAsText("note")).containsExactly("before", "The robot turns too early");
        assertThat(olga.get("/api/missions/other/markers")).isEmpty();

        assertThat(olga.error("DELETE", "/api/missions/other/markers/" + id, null))
                .isEqualTo("404 unknown-marker");
        assertThat(olga.status("DELETE", MARKERS + "/" + id, null)).isEqualTo(200);
        assertThat(olga.get(MARKERS).findValuesAsText("note")).containsExactly("before");
        await().until(() -> olga.get("/api/audit").size() == 5);
        assertThat(olga.get("/api/audit"))
                .allSatisfy(entry -> assertThat(entry.path("user").asText()).isEqualTo("olga"))
                .extracting(entry -> entry.path("command").asText() + " "
                        + entry.path("result").asText())
                .containsExactly(
                        "remove-marker deleted",
                        "remove-marker error",
                        "add-marker created",
                        "add-marker created",
                        "add-marker created");
    }

    @Test
    void rejectsInvalidMarkers() throws Exception {
        assertThat(olga.error(add("{\"note\":\"n\"}", "k-1"))).isEqualTo("400 missing-member");
        assertThat(olga.error(add("{\"time\":\"noon\",\"note\":\"n\"}", "k-2"))).isEqualTo("400 wrong-member");
        assertThat(olga.error(add("{\"time\":5}", "k-3"))).isEqualTo("400 missing-member");
        assertThat(olga.error(add("{\"time\":5,\"note\":\" \"}", "k-4"))).isEqualTo("400 wrong-member");
        assertThat(olga.error(add("{\"time\":-5,\"note\":\"n\"}", "k-5"))).isEqualTo("400 wrong-member");
        assertThat(olga.error(add("{\"time\":5,\"note\":\"" + "x".repeat(1001) + "\"}", "k-6")))
                .isEqualTo("400 wrong-member");
    }

    @Test
    void reportsAnUnavailableMongoDb() throws Exception {
        mongo.close();
        HttpResponse<byte[]> unavailable = olga.send("GET", MARKERS, null);
        assertThat(olga.error(unavailable)).isEqualTo("503 mongodb-away");
        assertThat(olga.json(unavailable).path("reason").asText()).contains("weeding", "Check that MongoDB runs");
        assertThat(olga.error(add("{\"time\":5,\"note\":\"n\"}", "k-1"))).isEqualTo("503 mongodb-away");
    }
}
