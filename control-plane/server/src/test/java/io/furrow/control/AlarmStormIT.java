package io.furrow.control;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.Map;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestReporter;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.control.device.DeviceCommands;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Raises many alarms at once with a failing webhook, on a real Kafka and HTTP servers. */
@Tag("full")
class AlarmStormIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(90);
    private static final int DEVICES = 10_000;
    private static final String ROBOT = "urn:ngsi-ld:Robot:m-1";

    @TempDir
    Path directory;

    private final List<JsonNode> posted = Collections.synchronizedList(new ArrayList<>());
    private final List<Long> stopped = Collections.synchronizedList(new ArrayList<>());
    private final CountDownLatch release = new CountDownLatch(1);
    private EmbeddedKafka kafka;
    private KafkaProducer<String, byte[]> producer;
    private volatile boolean blocked;
    private volatile String failing = "";

    @AutoClose
    private final StubServer webhook = new StubServer(exchange -> {
        JsonNode alarm = NgsiJson.mapper().readTree(exchange.getRequestBody());
        if (blocked) {
            awaitEnd();
        }
        boolean fails = alarm.path("kind").asText().equals(failing);
        if (!fails) {
            posted.add(alarm);
        }
        StubServer.answer(exchange, fails ? 500 : 204, "");
    });

    @AutoClose
    private final StubServer broker = new StubServer(exchange -> {
        stopped.add(System.nanoTime());
        StubServer.answer(exchange, 204, "");
    });

    @BeforeEach
    void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        producer = KafkaClients.producer(kafka.client());
    }

    @AfterEach
    void stop() {
        release.countDown();
        producer.close();
        kafka.close();
    }

    @Test
    void deliversAnAlarmWhileAnotherOneFails() throws Exception {
        failing = "predicted-encounter";
        try (FarmWatch watch = watch()) {
            await().atMost(TIMEOUT).until(watch::isHealthy);
            encounter("a", "b", "predicted");
            encounter("c", "d", "started");
            await().atMost(TIMEOUT).until(() -> !posted.isEmpty());
            assertThat(posted.get(0).path("kind").asText()).isEqualTo("collision");
            failing = "";
            await().atMost(TIMEOUT)
                    .until(() -> posted.stream()
                            .anyMatch(each -> each.path("kind").asText().equals("predicted-encounter")));
        }
    }

    /** Stop commands do not wait for alarms. */
    @Test
    void stopsARobotWhileTenThousandDevicesFallSilentAndTheWebhookHangs(TestReporter reporter) throws Exception {
        blocked = true;
        try (FarmWatch watch = watch()) {
            addDesired(ROBOT, "Robot", Duration.ofHours(1));
            for (int i = 0; i < DEVICES; i++) {
                addDesired("urn:ngsi-ld:Thermometer:m-" + i, "Thermometer", Duration.ofSeconds(1));
            }
            await().atMost(TIMEOUT).until(watch::isHealthy);
            await().atMost(TIMEOUT).until(() -> {
                for (int i = 0; i < DEVICES; i++) {
                    report("urn:ngsi-ld:Thermometer:m-" + i, "Thermometer");
                }
                producer.flush();
                return new TopicContent(kafka.client(), Topics.DEVICES_HEALTH)
                                .newest()
                                .size()
                        > DEVICES;
            });
            long reported = System.nanoTime();
            await().atMost(TIMEOUT).until(() -> silent() == DEVICES);
            long silent = System.nanoTime();

            long predictedAt = System.nanoTime();
            encounter(ROBOT, "somebody", "predicted");
            await().atMost(TIMEOUT).pollInterval(Duration.ofMillis(1)).until(() -> !stopped.isEmpty());

            reporter.publishEntry(Map.of(
                    "from the last report to 10,000 silent devices, 3 s of them silence",
                    TimeUnit.NANOSECONDS.toMillis(silent - reported) + " ms",
                    "from the record on data.collision to the PATCH",
                    TimeUnit.NANOSECONDS.toMillis(stopped.get(0) - predictedAt) + " ms"));
            assertThat(posted).isEmpty();
        }
    }

    private long silent() {
        return new TopicContent(kafka.client(), Topics.DEVICES_HEALTH)
                .newest().values().stream()
                        .filter(health -> new String(health, UTF_8).contains("\"silent\":true"))
                        .count();
    }

    private FarmWatch watch() throws Exception {
        WatchOptions options = WatchOptions.DEFAULT
                .with(Webhook.Settings.of(webhook.uri("")))
                .with(StopRobots.Settings.of(
                        new DeviceCommands(broker.uri(""), FiwareScope.DEFAULT, AccessToken.NONE)));
        return FarmWatch.start(
                ControlPlaneProcess.settings(
                        kafka.bootstrapServers(), directory.resolve("state").toString()),
                options);
    }

    private void awaitEnd() {
        try {
            release.await();
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    private void addDesired(String id, String type, Duration period) {
        DeviceVersion version = new DeviceVersion(id, "", "/", "north", "m", System.currentTimeMillis(), null, 1, null);
        DesiredDevice device = DesiredDevice.simulated(
                version, type, id, true, period, NgsiJson.mapper().createObjectNode());
        producer.send(new ProducerRecord<>(Topics.DEVICES, version.key(), device.toBytes()));
    }

    private void report(String id, String type) {
        producer.send(
                new ProducerRecord<>(Topics.RAW, id, Entity.builder(id, type).toBytes()));
    }

    private void encounter(String first, String second, String phase) {
        EntityBuilder entity = Entity.builder("Analytics:Collision:1:" + phase, "Analytics:Collision")
                .text("encounter", first + "-" + phase)
                .text("phase", phase)
                .text("Device1_ID", first)
                .text("Device1_Mission", "m")
                .text("Device2_ID", second)
                .number("distance", 12)
                .number("dcpa", 0.5);
        producer.send(new ProducerRecord<>(Topics.COLLISION, first + "-" + second, entity.toBytes()));
    }
}
