package io.furrow.control.rest;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlPlaneProcess;
import io.furrow.control.ControlSettings;
import io.furrow.control.readiness.HealthServer;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.http.AllowedNames;
import io.furrow.kafka.Probe;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Sends requests and probes to the API while one of its dependencies is unavailable. */
@Tag("full")
class OutagesIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final int COMMANDS = 200;

    @TempDir
    Path directory;

    private final int port = FreePort.orFree(0);
    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final List<AutoCloseable> parts = new ArrayList<>();
    private EmbeddedKafka kafka;
    private StubContextBroker broker;
    private RestApi api;
    private URI health;

    @BeforeEach
    void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"), port);
        broker = part(new StubContextBroker());
        Readiness readiness = new Readiness(Clock.systemUTC());
        readiness.require(part(Probe.kafka(settings().client()))::status);
        readiness.show(part(Probe.http("contextBroker", broker.uri().resolve("/version")))::status);
        readiness.require(part(ControlPlane.start(settings()))::status);
        RestSettings rest = RestSettings.on(0).withContextBroker(broker.uri());
        api = part(RestApi.start(settings(), rest, readiness));
        health = part(HealthServer.start(
                        "127.0.0.1", 0, AllowedNames.NONE, new HealthServer.Pages(readiness, api::metrics)))
                .uri();
        await().atMost(TIMEOUT).until(() -> status("ready").equals("ready"));
    }

    private <T extends AutoCloseable> T part(T part) {
        parts.add(0, part);
        return part;
    }

    @AfterEach
    void stop() throws Exception {
        for (AutoCloseable part : parts) {
            part.close();
        }
        kafka.close();
    }

    @Test
    void answersWhileTheContextBrokerHangs() throws Exception {
        post("/api/domains", "{\"domain\":\"north\"}").get();
        post("/api/missions/m/start", "{\"domain\":\"north\",\"devices\":[\"urn:own:1\"]}")
                .get();
        CountDownLatch held = new CountDownLatch(1);
        broker.hold(held);
        List<CompletableFuture<Integer>> commands = new ArrayList<>();
        for (int i = 0; i < COMMANDS; i++) {
            commands.add(post("/api/devices/urn:own:1/commands", "{\"command\":\"on\",\"type\":\"Pump\"}"));
        }
        // Requests beyond the limit and all others are answered immediately.
        await().atMost(TIMEOUT)
                .until(() -> commands.stream().filter(CompletableFuture::isDone).count() >= COMMANDS - 64);
        assertThat(status("health")).isEqualTo("up");
        assertThat(post("/api/domains", "{\"domain\":\"south\"}").get()).isEqualTo(201);
        held.countDown();
        for (CompletableFuture<Integer> command : commands) {
            assertThat(command.get(TIMEOUT.toSeconds(), TimeUnit.SECONDS)).isIn(202, 502, 503);
        }
        assertThat(commands.stream().filter(each -> each.join() == 503).count()).isGreaterThanOrEqualTo(COMMANDS - 128);
    }

    @Test
    void answersAndReportsWhileKafkaIsUnavailable() throws Exception {
        kafka.close();
        List<CompletableFuture<Integer>> stops = new ArrayList<>();
        for (int i = 0; i < COMMANDS; i++) {
            stops.add(post("/api/missions/m" + i + "/stop", ""));
        }
        assertThat(status("health")).isEqualTo("up");
        await().atMost(TIMEOUT).until(() -> status("ready").equals("not-ready"));
        assertThat(part("kafka").path("state").asText()).isEqualTo("down");
        assertThat(part("kafka").path("ageSeconds").asDouble()).isPositive();
        for (CompletableFuture<Integer> stop : stops) {
            assertThat(stop.get(TIMEOUT.toSeconds(), TimeUnit.SECONDS)).isEqualTo(503);
        }

        kafka = EmbeddedKafka.start(directory.resolve("kafka"), port);
        await().atMost(TIMEOUT).until(() -> status("ready").equals("ready"));
        await().atMost(TIMEOUT)
                .until(() -> post("/api/domains", "{\"domain\":\"back\"}").get() == 201);
    }

    @Test
    void showsAnUnavailableContextBroker() throws Exception {
        broker.answerWith(500);
        await().atMost(TIMEOUT).until(() -> status("ready").equals("degraded"));
        assertThat(part("contextBroker").path("detail").asText()).contains("answers 500");
        assertThat(get("/ready").statusCode()).isEqualTo(200);
        broker.answerWith(204);
        await().atMost(TIMEOUT).until(() -> status("ready").equals("ready"));
        assertThat(get("/nothing").statusCode()).isEqualTo(404);
        assertThat(new String(get("/metrics").body())).contains("furrow_control_view_complete 1");
    }

    private CompletableFuture<Integer> post(String path, String body) {
        HttpRequest request = HttpRequest.newBuilder(api.uri().resolve(path))
                .header("Content-Type", "application/json")
                .POST(HttpRequest.BodyPublishers.ofString(body))
                .build();
        return http.sendAsync(request, HttpResponse.BodyHandlers.discarding()).thenApply(HttpResponse::statusCode);
    }

    private HttpResponse<byte[]> get(String path) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(health.resolve(path)).build();
        return http.send(request, HttpResponse.BodyHandlers.ofByteArray());
    }

    private String status(String page) throws Exception {
        return NgsiJson.read(get("/" + page).body()).path("status").asText();
    }

    private JsonNode part(String name) throws Exception {
        return NgsiJson.read(get("/ready").body()).path("parts").path(name);
    }

    private ControlSettings settings() {
        return ControlPlaneProcess.settings(
                kafka.bootstrapServers(), directory.resolve("state").toString());
    }
}
