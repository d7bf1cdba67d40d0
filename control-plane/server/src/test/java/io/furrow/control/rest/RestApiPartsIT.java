package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlPlaneProcess;
import io.furrow.control.ControlSettings;
import io.furrow.control.FarmWatch;
import io.furrow.control.WatchOptions;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.Readiness;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Uses the API while other parts start and stop. */
@Tag("full")
class RestApiPartsIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final String DOMAIN = "{\"domain\":\"north\"}";

    @TempDir
    Path directory;

    private int port;
    private EmbeddedKafka kafka;
    private RestApi api;
    private ApiClient client;

    @BeforeEach
    void start() throws Exception {
        port = FreePort.orFree(0);
        kafka = EmbeddedKafka.start(directory.resolve("kafka"), port);
        api = RestApi.start(
                settings(), RestSettings.on(0).withTimeout(Duration.ofSeconds(1)), new Readiness(Clock.systemUTC()));
        client = new ApiClient(api.uri(), null);
        await().atMost(TIMEOUT).until(api::isReady);
    }

    @AfterEach
    void stop() {
        api.close();
        kafka.close();
    }

    @Test
    void executesARepeatedRequestOnce() throws Exception {
        assertThat(create("key-1").statusCode()).isEqualTo(503);
        assertThat(create("key-1").statusCode()).isEqualTo(503);
        try (ControlPlane plane = ControlPlane.start(settings())) {
            await().atMost(TIMEOUT).until(() -> create("key-1").statusCode() != 503);
            assertThat(plane.state()).isNotEqualTo("ERROR");
            assertThat(create("key-1").statusCode()).isEqualTo(201);

            kafka.close();
            assertThat(create("key-2").statusCode()).isEqualTo(503);
            kafka = EmbeddedKafka.start(directory.resolve("kafka"), port);
            await().atMost(TIMEOUT).until(() -> create("key-2").statusCode() == 409);
        }
        assertThat(client.get("/api/audit"))
                .filteredOn(entry -> entry.path("requestId").asText().equals("key-1"))
                .hasSize(1);
    }

    @Test
    void handlesTheLifeCycleOfAnAlarm() throws Exception {
        try (FarmWatch watch =
                        FarmWatch.start(settings(), WatchOptions.DEFAULT.withCollisionHolds(Duration.ofSeconds(1)));
                KafkaProducer<String, byte[]> producer =
                        KafkaClients.producer(settings().client())) {
            await().atMost(TIMEOUT).until(watch::isHealthy);
            producer.send(new ProducerRecord<>(Topics.COLLISION, "r1-r2", collision("started")));
            await().atMost(TIMEOUT)
                    .until(() -> client.get("/api/alarms?state=open").size() == 1);
            JsonNode alarm = client.get("/api/alarms").get(0);
            String path = "/api/alarms/" + alarm.path("alarm").asText();
            assertThat(alarm.path("kind").asText()).isEqualTo("collision");

            assertThat(client.get(path)).isEqualTo(alarm);
            long raised = alarm.path("raised").asLong();
            assertThat(client.get("/api/alarms?kind=collision&to=" + (raised + 1)))
                    .hasSize(1);
            assertThat(client.get("/api/alarms?to=" + raised)).isEmpty();
            assertThat(client.get("/api/alarms?kind=fault")).isEmpty();

            assertThat(answered(path + "/acknowledge", null)).isEqualTo(200);
            assertThat(answered(path + "/mute", "{\"for\":\"PT1H\"}")).isEqualTo(200);
            assertThat(answered(path + "/unmute", null)).isEqualTo(200);
            assertThat(answered("/api/alarms/mute", "{\"kind\":\"silent-device\",\"for\":\"PT1H\"}"))
                    .isEqualTo(200);
            assertThat(answered("/api/alarms/unmute", "{\"kind\":\"silent-device\"}"))
                    .isEqualTo(200);
            assertThat(client.get("/api/alarms?from=" + (System.currentTimeMillis() + 60_000)))
                    .as("it is not closed")
                    .hasSize(1);
            assertThat(answered(path + "/close", null))
                    .as("while its cause lasts")
                    .isEqualTo(409);
            producer.send(new ProducerRecord<>(Topics.COLLISION, "r1-r2", collision("ended")));
            await().atMost(TIMEOUT)
                    .until(() -> client.get("/api/alarms?state=closed&limit=1").size() == 1);
            assertThat(client.get("/api/alarms?state=closed")
                            .get(0)
                            .path("acknowledgedBy")
                            .asText())
                    .isEqualTo("rest");
            long closed = client.get(path).path("changed").asLong();
            assertThat(client.get("/api/alarms?from=" + closed)).hasSize(1);
            assertThat(client.get("/api/alarms?from=" + (closed + 1))).isEmpty();
            assertThat(answered(path + "/close", null)).isEqualTo(409);
            assertThat(answered("/api/alarms/nosuch/close", null)).isEqualTo(404);
            assertThat(answered(path + "/mute", "{}")).isEqualTo(400);
        }
    }

    /** Repeats a request until it is answered, because the timeout is a second. */
    private int answered(String path, String body) throws Exception {
        String key = java.util.UUID.randomUUID().toString();
        await().atMost(TIMEOUT)
                .until(() -> client.status("POST", path, body == null ? "" : body, "Idempotency-Key", key) != 503);
        return client.status("POST", path, body == null ? "" : body, "Idempotency-Key", key);
    }

    private HttpResponse<byte[]> create(String key) throws Exception {
        return client.send("POST", "/api/domains", DOMAIN, "Idempotency-Key", key);
    }

    private static byte[] collision(String phase) {
        return Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                .text("encounter", "e-1")
                .text("phase", phase)
                .text("Device1_ID", "r1")
                .text("Device1_Mission", "m")
                .text("Device2_ID", "r2")
                .text("Device2_Mission", "")
                .number("distance", 2)
                .number("minDistance", 2)
                .toBytes();
    }

    private ControlSettings settings() {
        return ControlPlaneProcess.settings(
                kafka.bootstrapServers(), directory.resolve("state").toString());
    }
}
