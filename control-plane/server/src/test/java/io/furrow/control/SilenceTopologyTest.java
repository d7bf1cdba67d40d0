package io.furrow.control;

import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.IntFunction;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.tuple;

class SilenceTopologyTest {
    private static final Duration REQUEST_RETENTION = Duration.ofHours(1);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void raisesAnAlarmUntilASilentDeviceReportsAgain() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", true);
        report("");
        farm.pass(Duration.ofSeconds(30));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.pass(Duration.ofSeconds(1));
        farm.pass(Duration.ofSeconds(1));
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("silent-device");
        assertThat(alarm.path("subject").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(alarm.at("/devices/0/type").asText()).isEqualTo("Thermometer");
        assertThat(farm.newest(Topics.DEVICES_HEALTH).path("silent").asBoolean())
                .isTrue();

        report("");
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        assertThat(farm.newest(Topics.DEVICES_HEALTH).path("silent").asBoolean(true))
                .isFalse();
    }

    @Test
    void raisesOneAlarmForAllSilentDevicesOfAMission() throws Exception {
        addThermometers(i -> "m");
        passTimeWithReports(3, 40);
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
    void raisesAMissionAlarmIfManyDevicesAreSilent() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", "other", true);
        addThermometers(i -> "m");
        passTimeWithReports(0, 0);
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
    void raisesOneFarmAlarmIfNoReportsArrive() throws Exception {
        addThermometers(i -> "m" + i % 10);
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
    void inhibitsMissionAlarmsDuringRecovery() throws Exception {
        addThermometers(i -> "m" + i % 10);
        for (int i = 0; i < 120; i++) {
            farm.pass(Duration.ofSeconds(1));
        }
        Map<String, JsonNode> open = new LinkedHashMap<>();
        farm.all(Topics.ALARMS).forEach(alarm -> open.put(alarm.path("alarm").asText(), alarm));
        assertThat(open).isNotEmpty();
        for (int second = 0; second < 90; second++) {
            farm.pass(Duration.ofSeconds(1));
            for (int i = 1; i <= Math.min(40, second); i++) {
                report(i);
            }
        }
        assertThat(farm.all(Topics.ALARMS))
                .as("only ends; all but that of the farm stay inhibited")
                .filteredOn(alarm -> !alarm.path("kind").asText().equals("silent-farm"))
                .allMatch(alarm -> alarm.has("inhibitedBy"))
                .filteredOn(alarm -> alarm.path("state").asText().equals("closed"))
                .hasSize(open.size() - 1);
    }

    /** One device reports every five seconds, while each emits a heartbeat every thirty. */
    @Test
    void raisesNoFarmAlarmWhileOneDeviceReports() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", "other", true);
        addThermometers(i -> "m");
        for (int second = 0; second < 300; second++) {
            farm.pass(Duration.ofSeconds(1));
            if (second % 5 == 0) {
                report("");
            }
        }
        assertThat(farm.all(Topics.ALARMS))
                .extracting(alarm -> alarm.path("kind").asText())
                .contains("silent-mission")
                .doesNotContain("silent-farm");
        assertThat(farm.heartbeats().stream().filter(key -> key.isEmpty()).count())
                .isBetween(50L, 61L);
    }

    @Test
    void rejectsClosingAnOngoingSilence() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", true);
        report("");
        farm.pass(Duration.ofSeconds(30));
        farm.pass(Duration.ofSeconds(1));
        farm.pass(Duration.ofSeconds(1));
        farm.request(Topics.ALARM_MANAGER, "'command':'close','alarm':'silent-device-1'");
        assertThat(farm.newest(Topics.ALARM_MANAGER).path("reason").asText())
                .contains("silent-device-1", "1 of 1 device of mission m is silent", "mute");
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("open");
    }

    /** Forty, each of which reports once. */
    private void addThermometers(IntFunction<String> mission) throws Exception {
        for (int i = 1; i <= 40; i++) {
            farm.addDesired(THERMOMETER + i, "Thermometer", mission.apply(i), true);
            report(i);
        }
    }

    private void report(Object number) throws Exception {
        farm.report(Entity.builder(THERMOMETER + number, "Thermometer"));
    }

    /** Two minutes, in which some of the devices continue reporting. */
    private void passTimeWithReports(int from, int to) throws Exception {
        for (int i = 0; i < 120; i++) {
            farm.pass(Duration.ofSeconds(1));
            report("");
            for (int device = from; device <= to && from > 0; device++) {
                report(device);
            }
        }
    }

    private static List<JsonNode> newestOfEach(List<JsonNode> alarms) {
        Map<String, JsonNode> newest = new LinkedHashMap<>();
        alarms.forEach(alarm -> newest.put(alarm.path("alarm").asText(), alarm));
        return List.copyOf(newest.values());
    }
}
