package io.furrow.control;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.common.header.internals.RecordHeaders;
import org.apache.kafka.common.serialization.ByteArrayDeserializer;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringDeserializer;
import org.apache.kafka.common.serialization.StringSerializer;
import org.apache.kafka.streams.StreamsConfig;
import org.apache.kafka.streams.TopologyTestDriver;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class WatchTopologyTest {
    private static final Instant START = Instant.parse("2026-03-01T08:00:00Z");
    private static final Duration REMEMBERED = Duration.ofHours(1);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";
    private static final String ROBOT = "robot-1";

    private final TopologyTestDriver driver =
            new TopologyTestDriver(WatchTopology.of(REMEMBERED, WatchOptions.DEFAULT), settings(), START);
    private Instant now = START;

    @AfterEach
    void close() {
        driver.close();
    }

    @Test
    void publishesWhenADeviceWasLastSeenAndHowFullItsBatteryIs() throws Exception {
        want(THERMOMETER, "Thermometer", true);
        pass(Duration.ofSeconds(1));
        report(Entity.builder(THERMOMETER, "Thermometer").number("battery", 81.5));

        JsonNode health = newest(Topics.DEVICES_HEALTH);
        assertThat(health.path("lastSeen").asLong()).isEqualTo(now.toEpochMilli());
        assertThat(health.path("battery").asDouble()).isEqualTo(81.5);
        assertThat(health.path("silent").asBoolean(true)).isFalse();
        assertThat(health.path("mission").asText()).isEqualTo("m");
    }

    @Test
    void raisesAnAlarmOfADeviceThatIsSilentAndEndsItWhenItReportsAgain() throws Exception {
        want(THERMOMETER, "Thermometer", true);
        report(Entity.builder(THERMOMETER, "Thermometer"));
        pass(Duration.ofSeconds(30));
        assertThat(read(Topics.ALARMS)).isEmpty();
        pass(Duration.ofSeconds(1));
        JsonNode alarm = newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("silent-device");
        assertThat(alarm.path("subject").asText()).isEqualTo(THERMOMETER);
        assertThat(alarm.path("devices").path(0).path("type").asText()).isEqualTo("Thermometer");
        assertThat(newest(Topics.DEVICES_HEALTH).path("silent").asBoolean()).isTrue();

        report(Entity.builder(THERMOMETER, "Thermometer"));
        assertThat(newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        assertThat(newest(Topics.DEVICES_HEALTH).path("silent").asBoolean(true)).isFalse();
    }

    @Test
    void raisesAnAlarmOfACollisionUntilItHasEnded() throws Exception {
        want(ROBOT, null, true);
        report(Entity.builder(ROBOT, "ROBOT"));
        encounter("predicted");
        JsonNode predicted = newest(Topics.ALARMS);
        assertThat(predicted.path("kind").asText()).isEqualTo("predicted-encounter");
        assertThat(predicted.path("devices").path(0).path("type").asText()).isEqualTo("ROBOT");
        encounter("predicted");
        assertThat(read(Topics.ALARMS)).isEmpty();
        encounter("started");
        List<JsonNode> both = all(Topics.ALARMS);
        assertThat(both).extracting(each -> each.path("state").asText()).containsExactly("closed", "open");
        assertThat(both.get(1).path("severity").asText()).isEqualTo("critical");
        encounter("ongoing");
        encounter("ended");
        assertThat(newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void raisesAnAlarmOfASensorThatIsSetAsideUntilItIsNotForThreeWindows() throws Exception {
        temperature(List.of(THERMOMETER));
        assertThat(newest(Topics.ALARMS).path("kind").asText()).isEqualTo("suspect-sensor");
        pass(Duration.ofSeconds(60));
        temperature(List.of(THERMOMETER));
        temperature(List.of());
        pass(Duration.ofSeconds(89));
        assertThat(read(Topics.ALARMS)).isEmpty();
        pass(Duration.ofSeconds(1));
        assertThat(newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void answersWhatIsAskedOfAlarms() throws Exception {
        encounter("started");
        newest(Topics.ALARMS);
        ask("{'type':'request','requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'}");
        ask("{'type':'request','requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'}");
        ask("{'type':'request','command':'mute','kind':'collision','for':'PT1H'}");
        ask("{'type':'request','command':'close','alarm':'collision-9'}");

        assertThat(all(Topics.ALARM_MANAGER))
                .extracting(each -> each.path("status").asText())
                .containsExactly("acknowledged", "muted", "error");
        List<JsonNode> alarms = all(Topics.ALARMS);
        assertThat(alarms.get(0).path("acknowledgedBy").asText()).isEqualTo("ann");
        assertThat(alarms.get(1).path("mutedUntil").asLong())
                .isEqualTo(now.plus(Duration.ofHours(1)).toEpochMilli());
    }

    @Test
    void passesOverWhatItCannotRead() {
        pipe(Topics.COLLISION, "a-b", "{}".getBytes(StandardCharsets.UTF_8));
        pipe(Topics.TEMPERATURE, "f", "[".getBytes(StandardCharsets.UTF_8));
        pipe(Topics.RAW, "x", "[".getBytes(StandardCharsets.UTF_8));
        pipe(Topics.DEVICES, "|/|x", "[".getBytes(StandardCharsets.UTF_8));
        pipe(Topics.RAW, "x", "[".getBytes(StandardCharsets.UTF_8));
        assertThat(read(Topics.ALARMS)).isEmpty();
        encounter("started");
        assertThat(read(Topics.ALARMS)).hasSize(1);
    }

    /** State and offsets are found by these names. */
    @Test
    void hasANameForEveryStoreAndEveryTopicOfItsOwn() {
        assertThat(WatchTopology.of(REMEMBERED, WatchOptions.DEFAULT).describe().toString())
                .doesNotContain("-0000")
                .contains(
                        "alarm-requests-repartition",
                        "device-signs-repartition",
                        "collisions-repartition",
                        "temperatures-repartition");
        assertThat(driver.getAllStateStores().keySet())
                .isEqualTo(Set.of(
                        "alarms",
                        "current-alarms",
                        "alarm-mutes",
                        "alarm-sequence",
                        "alarm-answers",
                        "alarm-positions",
                        "wanted-devices",
                        "device-health"));
    }

    private void want(String id, String type, boolean running) {
        Long until = running ? null : Long.valueOf(now.toEpochMilli());
        DeviceVersion version = new DeviceVersion(id, "farm", "/", "north", "m", START.toEpochMilli(), until, 1, null);
        WantedDevice device = new WantedDevice(
                version,
                type,
                type == null ? null : id,
                running,
                Duration.ofSeconds(10),
                NgsiJson.mapper().createObjectNode());
        pipe(Topics.DEVICES, version.key(), device.toBytes());
    }

    private void report(EntityBuilder entity) {
        pipe(Topics.RAW, entity.id(), entity.toBytes());
    }

    private void encounter(String phase) {
        EntityBuilder entity = Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                .text("encounter", "e-" + phase)
                .text("phase", phase)
                .text("Device1_ID", ROBOT)
                .text("Device1_Mission", "m")
                .text("Device2_ID", "robot-2")
                .text("Device2_Mission", "")
                .number("distance", 3.2);
        pipe(Topics.COLLISION, ROBOT + "-robot-2", entity.toBytes());
    }

    private void temperature(List<String> suspects) {
        EntityBuilder entity = Entity.builder("Analytics:FieldTemperature:f", "Analytics:FieldTemperature")
                .text("field", "f")
                .texts("suspects", suspects)
                .integer("windowStart", now.toEpochMilli() - 30_000)
                .integer("windowEnd", now.toEpochMilli());
        pipe(Topics.TEMPERATURE, "f", entity.toBytes());
    }

    private void ask(String json) {
        pipe(Topics.ALARM_MANAGER, null, json.replace('\'', '"').getBytes(StandardCharsets.UTF_8));
    }

    private void pipe(String topic, String key, byte[] value) {
        RecordHeaders headers = new RecordHeaders();
        Map.of(HeaderNames.SERVICE, "farm", HeaderNames.SERVICE_PATH, "/")
                .forEach((name, text) -> headers.add(name, text.getBytes(StandardCharsets.UTF_8)));
        driver.createInputTopic(topic, new StringSerializer(), new ByteArraySerializer())
                .pipeInput(new TestRecord<>(key, value, headers, now));
    }

    private void pass(Duration time) {
        now = now.plus(time);
        driver.advanceWallClockTime(time);
    }

    private List<TestRecord<String, byte[]>> read(String topic) {
        return driver.createOutputTopic(topic, new StringDeserializer(), new ByteArrayDeserializer())
                .readRecordsToList();
    }

    private List<JsonNode> all(String topic) throws Exception {
        List<JsonNode> all = new ArrayList<>();
        for (TestRecord<String, byte[]> record : read(topic)) {
            all.add(NgsiJson.read(record.value()));
        }
        return all;
    }

    private JsonNode newest(String topic) throws Exception {
        List<JsonNode> all = all(topic);
        assertThat(all).isNotEmpty();
        return all.get(all.size() - 1);
    }

    private static Properties settings() {
        Properties settings = new Properties();
        settings.setProperty(StreamsConfig.APPLICATION_ID_CONFIG, FarmWatch.APPLICATION);
        settings.setProperty(StreamsConfig.BOOTSTRAP_SERVERS_CONFIG, "unused:0");
        settings.setProperty(StreamsConfig.PROCESSING_GUARANTEE_CONFIG, StreamsConfig.EXACTLY_ONCE_V2);
        return settings;
    }
}
