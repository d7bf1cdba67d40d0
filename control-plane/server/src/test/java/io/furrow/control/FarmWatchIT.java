package io.furrow.control;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.awaitility.Awaitility;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.alarm.action.StopRobots;
import io.furrow.control.alarm.action.Webhook;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.KafkaClients;
import io.furrow.model.control.AlarmCommand;
import io.furrow.model.control.Requests;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;
import io.furrow.stub.StubServer;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

/** Runs the farm watch on a real Kafka, with a webhook that is sometimes unavailable. */
class FarmWatchIT {
    private static final Duration TIMEOUT = Duration.ofSeconds(120);
    private static final String ROBOT = "robot-1";

    @TempDir
    Path directory;

    private final List<JsonNode> posted = Collections.synchronizedList(new ArrayList<>());
    private final List<String> sent = Collections.synchronizedList(new ArrayList<>());
    private EmbeddedKafka kafka;
    private KafkaProducer<String, byte[]> producer;
    private volatile boolean webhookAvailable = true;
    private WatchOptions options;

    @AutoClose
    private final StubServer webhook = new StubServer(exchange -> {
        JsonNode alarm = NgsiJson.mapper().readTree(exchange.getRequestBody());
        StubServer.answer(exchange, webhookAvailable ? 204 : 503, "");
        if (webhookAvailable) {
            posted.add(alarm);
        }
    });

    @BeforeEach
    void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        producer = KafkaClients.producer(kafka.client());
        options = WatchOptions.DEFAULT
                .withCollisionHolds(Duration.ofSeconds(1))
                .with(Webhook.Settings.of(webhook.uri("")).withGroupWait(Duration.ZERO))
                .with(StopRobots.Settings.of((device, type, command, value) -> sent.add(device + " " + command)));
    }

    @AfterEach
    void stop() {
        producer.close();
        kafka.close();
    }

    @Tag("full")
    @Test
    void reportsADeviceThatFallsSilentAndRecovers() throws Exception {
        try (FarmWatch watch = watch("one")) {
            assertThat(watch.state()).isNotEqualTo("ERROR");
            addDesired();
            await(() -> {
                report();
                return !records(Topics.DEVICES_HEALTH).isEmpty()
                        && newest(Topics.DEVICES_HEALTH).path("lastSeen").isIntegralNumber();
            });
            await(() -> state("silent-device").equals("open"));
            await(() -> !posted.isEmpty());
            await(() -> {
                report();
                return state("silent-device").equals("closed");
            });
            await(() -> posted.size() >= 2);
        }
        assertThat(posted)
                .extracting(alarm -> alarm.path("id").asText())
                .startsWith("silent-device-1:1", "silent-device-1:2")
                .doesNotHaveDuplicates();
    }

    @Tag("full")
    @Test
    void deliversAnAlarmAfterOutagesOfWebhookAndWatch() throws Exception {
        webhookAvailable = false;
        try (FarmWatch watch = watch("one")) {
            encounter("started");
            await(() -> state("collision").equals("open"));
            encounter("ended");
            await(() -> state("collision").equals("closed"));
            await(() -> watch.workers().get(0).detail().contains("it responded with 503"));
            assertThat(watch.workers())
                    .extracting(ComponentStatus::name, ComponentStatus::state)
                    .containsExactly(
                            tuple("webhook", ComponentStatus.State.UP),
                            tuple("device-types", ComponentStatus.State.UP),
                            tuple("stop-on-predicted", ComponentStatus.State.UP));
            assertThat(watch.workers().get(0).lastSuccess()).isNull();
        }
        webhookAvailable = true;
        try (FarmWatch watch = watch("two")) {
            await(() -> !posted.isEmpty());
            await(() -> watch.workers().get(0).lastSuccess() != null);
        }
        assertThat(posted).extracting(alarm -> alarm.path("id").asText()).containsExactly("collision-1:2");
        try (FarmWatch watch = watch("three")) {
            encounter("started");
            await(() -> posted.size() > 1);
            assertThat(watch.workers().get(0).detail()).contains("0 rejected");
        }
        assertThat(posted)
                .as("delivered once")
                .extracting(alarm -> alarm.path("id").asText())
                .containsExactly("collision-1:2", "collision-3:3");
    }

    @Tag("full")
    @Test
    void stopsRobotsOnceAndRestoresAlarmsAfterARestart() throws Exception {
        try (FarmWatch watch = watch("one")) {
            assertThat(watch.state()).isNotEqualTo("ERROR");
            addDesired();
            await(() -> {
                report();
                return !records(Topics.DEVICES_HEALTH).isEmpty()
                        && newest(Topics.DEVICES_HEALTH).path("type").asText().equals("ROBOT");
            });
            predict();
            await(() -> audited().size() == 2);
        }
        assertThat(audited())
                .satisfiesExactlyInAnyOrder(
                        entry -> assertThat(entry).contains(ROBOT, "\"result\":\"sent\""),
                        entry -> assertThat(entry).contains("somebody", "the type of its entity is unknown"));
        assertThat(sent).containsExactly(ROBOT + " Stop");

        String alarm = "predicted-encounter-1";
        try (FarmWatch watch = watch("two")) { // restores its state from Kafka
            assertThat(watch.state()).isNotEqualTo("ERROR");
            predict();
            producer.send(new ProducerRecord<>(
                    Topics.ALARM_MANAGER, Requests.write("r", new AlarmCommand.Acknowledge(alarm, "ann"))));
            await(() -> audited().stream()
                            .filter(entry -> entry.contains("somebody"))
                            .count()
                    == 2); // so it has processed the prediction
            await(() -> state("predicted-encounter").equals("acknowledged"));
            await(() -> posted.stream()
                    .anyMatch(each -> each.path("change").asText().equals("acknowledged")));
        }
        assertThat(sent).hasSize(1);
    }

    @Tag("full")
    @Test
    void takesOverFromAnotherInstance() throws Exception {
        try (FarmWatch second = watch("two")) {
            try (FarmWatch first = watch("one")) {
                await(() -> first.isHealthy() && second.isHealthy());
                addDesired();
                await(() -> {
                    report();
                    return !records(Topics.DEVICES_HEALTH).isEmpty()
                            && newest(Topics.DEVICES_HEALTH).path("lastSeen").isIntegralNumber();
                });
                await(() -> state("silent-device").equals("open"));
            }
            await(() -> {
                report();
                return state("silent-device").equals("closed");
            });
        }
        List<String> opened = records(Topics.ALARMS).stream()
                .filter(record -> new String(record.value(), UTF_8).contains("\"opened\""))
                .map(ConsumerRecord::key)
                .toList();
        assertThat(opened).startsWith("silent-device-1").doesNotHaveDuplicates();
    }

    private FarmWatch watch(String state) throws Exception {
        Path own = directory.resolve(state);
        return FarmWatch.start(ControlPlaneProcess.settings(kafka.bootstrapServers(), own.toString()), options);
    }

    private void addDesired() {
        var version = new DeviceVersion(ROBOT, "", "/", "north", "m", System.currentTimeMillis(), null, 1, null);
        DesiredDevice device = DesiredDevice.simulated(
                version,
                null,
                null,
                true,
                Duration.ofSeconds(1),
                NgsiJson.mapper().createObjectNode());
        producer.send(new ProducerRecord<>(Topics.DEVICES, version.key(), device.toBytes()));
    }

    private void report() {
        EntityBuilder entity = Entity.builder(ROBOT, "ROBOT").text("battery", "{%27percentage%27: 0.5}");
        producer.send(new ProducerRecord<>(Topics.RAW, entity.id(), entity.toBytes()));
    }

    private void predict() {
        encounter("predicted");
    }

    private void encounter(String phase) {
        EntityBuilder entity = Entity.builder("Analytics:Collision:1:" + phase, "Analytics:Collision")
                .text("encounter", "e-1")
                .text("phase", phase)
                .text("Device1_ID", ROBOT)
                .text("Device2_ID", "somebody")
                .number("distance", 12)
                .number("dcpa", 0.5);
        producer.send(new ProducerRecord<>(Topics.COLLISION, ROBOT + "-somebody", entity.toBytes()));
    }

    private String state(String kind) throws Exception {
        String state = "";
        for (ConsumerRecord<String, byte[]> record : records(Topics.ALARMS)) {
            if (record.key().startsWith(kind)) {
                state = NgsiJson.read(record.value()).path("state").asText();
            }
        }
        return state;
    }

    private List<String> audited() {
        return records(Topics.AUDIT).stream()
                .map(record -> new String(record.value(), UTF_8))
                .toList();
    }

    private JsonNode newest(String topic) throws Exception {
        List<ConsumerRecord<String, byte[]>> all = records(topic);
        return NgsiJson.read(all.get(all.size() - 1).value());
    }

    private List<ConsumerRecord<String, byte[]>> records(String topic) {
        return new TopicContent(kafka.client(), topic).records();
    }

    private static void await(Callable<Boolean> condition) {
        Awaitility.await().atMost(TIMEOUT).until(condition);
    }
}
