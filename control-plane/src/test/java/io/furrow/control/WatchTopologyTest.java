package io.furrow.control;

import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.Limits;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class WatchTopologyTest {
    private static final Duration REMEMBERED = Duration.ofHours(1);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";

    private final WatchedFarm farm = new WatchedFarm();

    @AfterEach
    void close() {
        farm.close();
    }

    @Test
    void publishesWhenADeviceWasLastSeenAndHowFullItsBatteryIs() throws Exception {
        want(THERMOMETER, "Thermometer", true);
        farm.pass(Duration.ofSeconds(1));
        report(Entity.builder(THERMOMETER, "Thermometer").number("battery", 81.5));

        JsonNode health = farm.newest(Topics.DEVICES_HEALTH);
        assertThat(health.path("lastSeen").asLong()).isEqualTo(farm.now().toEpochMilli());
        assertThat(health.path("battery").asDouble()).isEqualTo(0.815);
        assertThat(health.path("silent").asBoolean(true)).isFalse();
        assertThat(health.path("mission").asText()).isEqualTo("m");
    }

    @Test
    void raisesAnAlarmOfADeviceThatIsSilentAndEndsItWhenItReportsAgain() throws Exception {
        want(THERMOMETER, "Thermometer", true);
        report(Entity.builder(THERMOMETER, "Thermometer"));
        farm.pass(Duration.ofSeconds(30));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.pass(Duration.ofSeconds(1));
        farm.pass(Duration.ofSeconds(1));
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("silent-device");
        assertThat(alarm.path("subject").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(alarm.path("devices").path(0).path("type").asText()).isEqualTo("Thermometer");
        assertThat(farm.newest(Topics.DEVICES_HEALTH).path("silent").asBoolean())
                .isTrue();

        report(Entity.builder(THERMOMETER, "Thermometer"));
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        assertThat(farm.newest(Topics.DEVICES_HEALTH).path("silent").asBoolean(true))
                .isFalse();
    }

    @Test
    void raisesOneAlarmForAllSilentDevicesOfAMission() throws Exception {
        for (int i = 1; i <= 40; i++) {
            want(THERMOMETER + i, "Thermometer", true);
            report(Entity.builder(THERMOMETER + i, "Thermometer"));
        }
        passKeepingAlive(3, 40);
        List<JsonNode> alarms = farm.all(Topics.ALARMS);
        assertThat(alarms).extracting(each -> each.path("alarm").asText()).containsOnly("silent-device-1");
        JsonNode alarm = alarms.get(alarms.size() - 1);
        assertThat(alarm.path("subject").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(alarm.path("text").asText())
                .isEqualTo("2 of 40 devices of mission m are silent: %s1, %s2".formatted(THERMOMETER, THERMOMETER));
        assertThat(alarm.path("affected").asInt()).isEqualTo(2);
        assertThat(alarm.path("total").asInt()).isEqualTo(40);
        assertThat(alarm.path("devices"))
                .extracting(device -> device.path("id").asText())
                .containsExactly(THERMOMETER + "1", THERMOMETER + "2");
    }

    @Test
    void saysThatAMissionIsAwayRatherThanItsDevices() throws Exception {
        want(THERMOMETER, "Thermometer", "other", true);
        for (int i = 1; i <= 40; i++) {
            want(THERMOMETER + i, "Thermometer", true);
            report(Entity.builder(THERMOMETER + i, "Thermometer"));
        }
        passKeepingAlive(0, 0);
        List<JsonNode> newest = newestOfEach(farm.all(Topics.ALARMS));
        assertThat(newest)
                .extracting(
                        each -> each.path("kind").asText(),
                        each -> each.path("severity").asText())
                .containsExactlyInAnyOrder(tuple("silent-device", "minor"), tuple("silent-mission", "major"));
        JsonNode mission = newest.stream()
                .filter(each -> each.path("kind").asText().equals("silent-mission"))
                .findFirst()
                .orElseThrow();
        assertThat(newest)
                .filteredOn(each -> each.path("kind").asText().equals("silent-device"))
                .allMatch(each -> each.path("inhibitedBy").equals(mission.path("alarm")));
    }

    @Test
    void saysOnceThatNothingArrivesAnyMore() throws Exception {
        for (int i = 1; i <= 40; i++) {
            want(THERMOMETER + i, "Thermometer", "m" + i % 10, true);
            report(Entity.builder(THERMOMETER + i, "Thermometer"));
        }
        for (int i = 0; i < 120; i++) {
            farm.pass(Duration.ofSeconds(1));
        }
        List<JsonNode> newest = newestOfEach(farm.all(Topics.ALARMS));
        assertThat(newest)
                .filteredOn(each -> !each.has("inhibitedBy"))
                .singleElement()
                .satisfies(farmIsSilent -> {
                    assertThat(farmIsSilent.path("kind").asText()).isEqualTo("silent-farm");
                    assertThat(farmIsSilent.path("severity").asText()).isEqualTo("critical");
                    assertThat(farmIsSilent.path("affected").asInt()).isEqualTo(40);
                });
    }

    @Test
    void deliversNoAlarmOfAMissionWhileReportsComeBack() throws Exception {
        for (int i = 1; i <= 40; i++) {
            want(THERMOMETER + i, "Thermometer", "m" + i % 10, true);
            report(Entity.builder(THERMOMETER + i, "Thermometer"));
        }
        for (int i = 0; i < 120; i++) {
            farm.pass(Duration.ofSeconds(1));
        }
        Map<String, JsonNode> open = new LinkedHashMap<>();
        farm.all(Topics.ALARMS).forEach(alarm -> open.put(alarm.path("alarm").asText(), alarm));
        assertThat(open).isNotEmpty();
        for (int second = 0; second < 90; second++) {
            farm.pass(Duration.ofSeconds(1));
            for (int i = 1; i <= Math.min(40, second); i++) {
                report(Entity.builder(THERMOMETER + i, "Thermometer"));
            }
        }
        assertThat(farm.all(Topics.ALARMS))
                .as("each only closes, and but for the farm's inhibited to its end")
                .filteredOn(alarm -> !alarm.path("kind").asText().equals("silent-farm"))
                .allMatch(alarm -> alarm.has("inhibitedBy"))
                .filteredOn(alarm -> alarm.path("state").asText().equals("closed"))
                .hasSize(open.size() - 1);
    }

    /** One device reports every five seconds while a sign of life of each comes every thirty. */
    @Test
    void doesNotSayThatNothingArrivesWhileOneDeviceReports() throws Exception {
        want(THERMOMETER, "Thermometer", "other", true);
        for (int i = 1; i <= 40; i++) {
            want(THERMOMETER + i, "Thermometer", true);
            report(Entity.builder(THERMOMETER + i, "Thermometer"));
        }
        for (int second = 0; second < 300; second++) {
            farm.pass(Duration.ofSeconds(1));
            if (second % 5 == 0) {
                report(Entity.builder(THERMOMETER, "Thermometer"));
            }
        }
        assertThat(farm.all(Topics.ALARMS))
                .extracting(alarm -> alarm.path("kind").asText())
                .contains("silent-mission")
                .doesNotContain("silent-farm");
        assertThat(farm.signs().stream().filter(key -> key.isEmpty()).count()).isBetween(50L, 61L);
    }

    @Test
    void doesNotLetASilenceBeClosedByHandWhileItLasts() throws Exception {
        want(THERMOMETER, "Thermometer", true);
        report(Entity.builder(THERMOMETER, "Thermometer"));
        farm.pass(Duration.ofSeconds(30));
        farm.pass(Duration.ofSeconds(1));
        farm.pass(Duration.ofSeconds(1));
        farm.pipe(Topics.ALARM_MANAGER, null, "{'type':'request','command':'close','alarm':'silent-device-1'}");
        assertThat(farm.newest(Topics.ALARM_MANAGER).path("reason").asText())
                .contains("silent-device-1", "1 of 1 devices of mission m", "mute");
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("open");
    }

    @Test
    void raisesACollisionAnewThatWasClosedByHandWhileTheEncounterLasts() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofMinutes(2));
        farm.pipe(Topics.ALARM_MANAGER, null, "{'type':'request','command':'close','alarm':'collision-1'}");
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        farm.encounter("ongoing", 3.2);
        JsonNode again = farm.newest(Topics.ALARMS);
        assertThat(again.path("state").asText()).isEqualTo("open");
        farm.pipe(
                Topics.ALARM_MANAGER,
                null,
                "{'type':'request','command':'close','alarm':'%s'}"
                        .formatted(again.path("alarm").asText()));
        assertThat(farm.newest(Topics.ALARM_MANAGER).path("error").asText()).isEqualTo("wrong-state");
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
    }

    @Test
    void raisesAnAlarmOfACollisionUntilItHasEnded() throws Exception {
        want(WatchedFarm.ROBOT, null, true);
        report(Entity.builder(WatchedFarm.ROBOT, "WatchedFarm.ROBOT"));
        farm.encounter("predicted", 3.2);
        JsonNode predicted = farm.newest(Topics.ALARMS);
        assertThat(predicted.path("kind").asText()).isEqualTo("predicted-encounter");
        assertThat(predicted.path("devices").path(0).path("type").asText()).isEqualTo("WatchedFarm.ROBOT");
        farm.encounter("predicted", 3.2);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.encounter("started", 3.2);
        List<JsonNode> both = farm.all(Topics.ALARMS);
        assertThat(both).extracting(each -> each.path("state").asText()).containsExactly("closed", "open");
        assertThat(both.get(1).path("severity").asText()).isEqualTo("critical");
        farm.encounter("ongoing", 3.2);
        farm.encounter("ended", 3.2);
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void raisesAnAlarmOfASensorThatIsSetAsideUntilItIsNotForThreeWindows() throws Exception {
        farm.temperature("f", 18, List.of(THERMOMETER));
        assertThat(farm.newest(Topics.ALARMS).path("kind").asText()).isEqualTo("suspect-sensor");
        farm.pass(Duration.ofSeconds(60));
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("f", 18, List.of());
        farm.pass(Duration.ofSeconds(89));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void answersWhatIsAskedOfAlarms() throws Exception {
        farm.encounter("started", 3.2);
        farm.newest(Topics.ALARMS);
        farm.pipe(
                Topics.ALARM_MANAGER,
                null,
                "{'type':'request','requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'}");
        farm.pipe(
                Topics.ALARM_MANAGER,
                null,
                "{'type':'request','requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'}");
        farm.pipe(Topics.ALARM_MANAGER, null, "{'type':'request','command':'mute','kind':'collision','for':'PT1H'}");
        farm.pipe(Topics.ALARM_MANAGER, null, "{'type':'request','command':'close','alarm':'collision-9'}");

        assertThat(farm.all(Topics.ALARM_MANAGER))
                .extracting(each -> each.path("status").asText())
                .containsExactly("acknowledged", "muted", "error");
        List<JsonNode> alarms = farm.all(Topics.ALARMS);
        assertThat(alarms.get(0).path("acknowledgedBy").asText()).isEqualTo("ann");
        assertThat(alarms.get(1).path("mutedUntil").asLong())
                .isEqualTo(farm.now().plus(Duration.ofHours(1)).toEpochMilli());
    }

    @Test
    void setsAsideWhatItCannotReadOnce() {
        farm.pipe(Topics.COLLISION, "a-b", "{}".getBytes(StandardCharsets.UTF_8));
        farm.pipe(Topics.TEMPERATURE, "f", "[".getBytes(StandardCharsets.UTF_8));
        farm.pipe(Topics.RAW, "x", "[".getBytes(StandardCharsets.UTF_8));
        farm.pipe(Topics.DEVICES, "|/|x", "[".getBytes(StandardCharsets.UTF_8));
        farm.pipe(Topics.RAW, "x", "[".getBytes(StandardCharsets.UTF_8));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.encounter("started", 3.2);
        assertThat(farm.read(Topics.ALARMS)).hasSize(1);

        assertThat(farm.read(Topics.dead(Topics.COLLISION)))
                .singleElement()
                .satisfies(
                        letter -> assertThat(header(letter, DeadLetter.SOURCE)).isEqualTo("data.collision-0@0"));
        assertThat(farm.read(Topics.dead(Topics.TEMPERATURE))).hasSize(1);
    }

    /** It would be the last record that is ever handled: no internal topic takes it. */
    @Test
    void setsAsideWhatIsTooLargeToBeHandled() {
        farm.pipe(Topics.COLLISION, "a-b", new byte[Limits.RECORD_BYTES]);
        farm.pipe(Topics.TEMPERATURE, "x".repeat(Limits.RECORD_BYTES), "{}");
        farm.encounter("started", 3.2);

        assertThat(farm.read(Topics.ALARMS)).hasSize(1);
        for (String topic : List.of(Topics.COLLISION, Topics.TEMPERATURE)) {
            assertThat(farm.read(Topics.dead(topic)))
                    .singleElement()
                    .satisfies(letter ->
                            assertThat(header(letter, DeadLetter.REASON)).isEqualTo("too-large"));
        }
    }

    private static String header(TestRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), StandardCharsets.UTF_8);
    }

    /** State and offsets are found by these names. */
    @Test
    void hasANameForEveryStoreAndEveryTopicOfItsOwn() {
        assertThat(WatchTopology.of(REMEMBERED, WatchOptions.DEFAULT, FiwareScope.DEFAULT)
                        .describe()
                        .toString())
                .doesNotContain("-0000")
                .contains(
                        "alarm-requests-repartition",
                        "device-signs-repartition",
                        "collisions-repartition",
                        "temperatures-repartition",
                        "context-domains-repartition",
                        "context-missions-repartition",
                        "context-mission-statuses-repartition");
        assertThat(farm.stores())
                .isEqualTo(Set.of(
                        "alarms",
                        "current-alarms",
                        "alarm-mutes",
                        "alarm-sequence",
                        "alarm-groups",
                        "alarm-counted",
                        "alarm-answers",
                        "alarm-positions",
                        "collisions-positions",
                        "temperatures-positions",
                        "wanted-devices",
                        "device-health",
                        "context-domains-positions",
                        "context-missions-positions",
                        "context-mission-statuses-positions",
                        "context-domains",
                        "context-missions",
                        "context-statuses",
                        "context-tallies",
                        "context-fields",
                        "context-outdated",
                        "context-told"));
    }

    /** Two minutes, in which some of the devices go on reporting. */
    private void passKeepingAlive(int from, int to) throws Exception {
        for (int i = 0; i < 120; i++) {
            farm.pass(Duration.ofSeconds(1));
            report(Entity.builder(THERMOMETER, "Thermometer"));
            for (int device = from; device <= to && from > 0; device++) {
                report(Entity.builder(THERMOMETER + device, "Thermometer"));
            }
        }
    }

    private static List<JsonNode> newestOfEach(List<JsonNode> alarms) {
        Map<String, JsonNode> newest = new LinkedHashMap<>();
        alarms.forEach(alarm -> newest.put(alarm.path("alarm").asText(), alarm));
        return List.copyOf(newest.values());
    }

    private void want(String id, String type, boolean running) {
        want(id, type, "m", running);
    }

    private void want(String id, String type, String mission, boolean running) {
        Long until = running ? null : Long.valueOf(farm.now().toEpochMilli());
        DeviceVersion version =
                new DeviceVersion(id, "farm", "/", "north", mission, WatchedFarm.START.toEpochMilli(), until, 1, null);
        WantedDevice device = new WantedDevice(
                version,
                type,
                type == null ? null : id,
                running,
                Duration.ofSeconds(10),
                NgsiJson.mapper().createObjectNode());
        farm.pipe(Topics.DEVICES, version.key(), device.toBytes());
    }

    private void report(EntityBuilder entity) {
        farm.pipe(Topics.RAW, entity.id(), entity.toBytes());
    }
}
