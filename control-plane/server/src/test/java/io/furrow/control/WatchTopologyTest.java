package io.furrow.control;

import java.time.Duration;
import java.util.List;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.streams.test.TestRecord;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.Limits;
import io.furrow.model.event.DeadLetter;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class WatchTopologyTest {
    private static final Duration REQUEST_RETENTION = Duration.ofHours(1);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void publishesLastReportAndBattery() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", true);
        farm.pass(Duration.ofSeconds(1));
        farm.report(Entity.builder(THERMOMETER, "Thermometer").number("battery", 81.5));

        JsonNode health = farm.newest(Topics.DEVICES_HEALTH);
        assertThat(health.path("lastSeen").asLong()).isEqualTo(farm.now().toEpochMilli());
        assertThat(health.path("battery").asDouble()).isEqualTo(0.815);
        assertThat(health.path("silent").asBoolean(true)).isFalse();
        assertThat(health.path("mission").asText()).isEqualTo("m");
    }

    /** If the clock of a device is far ahead, the event time is the time of receipt, which does not reveal the clock. */
    @Test
    void publishesTheTimeReportedByADevice() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", true);
        for (int report = 0; report < 2; report++) {
            farm.pass(Duration.ofSeconds(31));
            long time = farm.now().plusSeconds(3000).toEpochMilli();
            farm.report(Entity.builder(THERMOMETER, "Thermometer").integer("Time", time));

            JsonNode health = farm.newest(Topics.DEVICES_HEALTH);
            assertThat(health.path("deviceTime").asLong()).isEqualTo(time);
            assertThat(health.path("lastSeen").asLong()).isEqualTo(farm.now().toEpochMilli());
        }
    }

    @Test
    void raisesAnAlarmForADeviceWhosePositionsArriveTooLate() throws Exception {
        farm.addDesired(FarmWatchFixture.ROBOT, "ROBOT", true);
        farm.clockBehind(FarmWatchFixture.ROBOT, 999);
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("clock-behind");
        assertThat(alarm.path("severity").asText()).isEqualTo("major");
        assertThat(alarm.path("subject").asText()).isEqualTo(FarmWatchFixture.ROBOT);
        assertThat(alarm.path("group").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(alarm.path("text").asText())
                .isEqualTo("positions of robot-1 arrive 1.0 s too late and are dropped: check its clock and its link");
        farm.pass(Duration.ofMinutes(2));
        farm.clockBehind(FarmWatchFixture.ROBOT, 999);
        farm.pass(Duration.ofSeconds(179));
        farm.pipe(
                Topics.CLOCKS, "x", Entity.builder("x", "Analytics:ClockOffset").toBytes());
        assertThat(countClosedClockAlarms()).isZero();
        farm.pass(Duration.ofSeconds(1));
        assertThat(countClosedClockAlarms()).isEqualTo(1);
        farm.pipe(Topics.CLOCKS, "x", "{}".getBytes(UTF_8));
        assertThat(farm.read(Topics.dead(Topics.CLOCKS))).hasSize(1);
    }

    @Test
    void retainsTheAlarmOfADeviceThatReportsSeldomUntilItsReportsHaveEnded() throws Exception {
        for (int report = 0; report < 3; report++) {
            farm.pass(Duration.ofMinutes(report == 0 ? 0 : 5));
            farm.clockBehind("slow", 999, Duration.ofMinutes(5));
        }
        farm.pass(Duration.ofMinutes(2));
        assertThat(farm.all(Topics.ALARMS))
                .extracting(alarm -> alarm.path("change").asText())
                .containsExactly("opened");
        farm.pass(Duration.ofMinutes(17));
        assertThat(farm.all(Topics.ALARMS)).isEmpty();
        farm.pass(Duration.ofMinutes(1));
        assertThat(countClosedClockAlarms()).isEqualTo(1);
    }

    @Test
    void raisesOneAlarmPerEntityOfAnAmbiguousId() throws Exception {
        for (String[] each :
                new String[][] {{"farm", "ROBOT"}, {"other", "ROBOT"}, {"farm", "Camera"}, {"other", "ROBOT"}}) {
            EntityBuilder behind = Entity.builder("Analytics:ClockBehind:r", "Analytics:ClockBehind")
                    .text("device", "r")
                    .text("deviceType", each[1]);
            farm.pipe(Topics.CLOCKS, each[0], "r", behind.toBytes());
        }
        List<JsonNode> alarms = farm.all(Topics.ALARMS);
        assertThat(alarms)
                .extracting(alarm -> alarm.path("identity").asText())
                .containsExactly("farm|/|ROBOT|r", "other|/|ROBOT|r", "farm|/|Camera|r");
        assertThat(alarms).allMatch(alarm -> alarm.path("subject").asText().equals("r"));
        assertThat(alarms.get(1).path("devices"))
                .hasToString("[{\"id\":\"r\",\"type\":\"ROBOT\",\"service\":\"other\"}]");
        farm.request(Topics.ALARM_MANAGER, "'command':'acknowledge','alarm':'clock-behind-2'");
        assertThat(farm.all(Topics.ALARMS))
                .singleElement()
                .extracting(alarm -> alarm.path("identity").asText())
                .isEqualTo("other|/|ROBOT|r");
    }

    @Test
    void raisesAnAlarmForLateReportsOfAnyDevice() throws Exception {
        farm.pipe(
                Topics.CLOCKS,
                "t",
                "{'id':'Analytics:ClockBehind:t','type':'Analytics:ClockBehind','device':{'value':'t'},"
                        + "'late':{'value':7200000},'reports':{'value':31},'Mission':{'value':''}}");
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("clock-behind");
        assertThat(alarm.path("text").asText())
                .isEqualTo("reports of t arrive 2 h too late and are dropped: check its clock and its link");
        assertThat(alarm.at("/values/late").asDouble()).isEqualTo(7200);
    }

    @Test
    void raisesAnAlarmWhileAFaultIsRepeated() throws Exception {
        for (int minutes = 0; minutes < 5; minutes++) {
            farm.pipe(Topics.FAULTS, "connector ngsi-sink", "{'text':'it failed; restart it'}");
            farm.pass(Duration.ofMinutes(1));
        }
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("fault");
        assertThat(alarm.path("subject").asText()).isEqualTo("connector ngsi-sink");
        assertThat(alarm.path("text").asText()).isEqualTo("it failed; restart it");
        assertThat(alarm.path("state").asText()).isEqualTo("open");
        farm.pass(Duration.ofMinutes(3));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        farm.pipe(Topics.FAULTS, "x", "{}");
        assertThat(farm.read(Topics.dead(Topics.FAULTS))).hasSize(1);
    }

    @Test
    void namesMissingDevicesOfAMission() throws Exception {
        farm.addDesired("t", "Thermometer", true);
        farm.pipe(Topics.MISSIONS_STATUS, "m", status("starting", "[]", "null"));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                status("starting", "[{'id':'t','reason':'why'}]", "'1 of 2 devices is not up: t (why)'"));
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("missing-devices");
        assertThat(alarm.path("subject").asText()).isEqualTo("urn:ngsi-ld:Mission:m");
        assertThat(alarm.path("text").asText()).isEqualTo("mission m: 1 of 2 devices is not up: t (why)");
        assertThat(alarm.path("affected").asInt()).isEqualTo(1);
        assertThat(alarm.path("devices"))
                .containsExactly(NgsiJson.object()
                        .put("id", "t")
                        .put("type", "Thermometer")
                        .put("service", "farm"));
        farm.pipe(Topics.MISSIONS_STATUS, "m", status("running", "[]", "null"));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void updatesTheTextWithoutANewSequenceNumber() throws Exception {
        reportMissing("it has not connected");
        JsonNode raised = farm.newest(Topics.ALARMS);
        reportMissing("its password was refused once");
        JsonNode reworded = farm.newest(Topics.ALARMS);
        assertThat(reworded.path("text").asText()).isEqualTo("mission m: t (its password was refused once)");
        assertThat(reworded.path("sequence")).isEqualTo(raised.path("sequence"));
        assertThat(reworded.path("change").asText()).isEqualTo("opened");
    }

    @Test
    void publishesTheFinalExtentAfterQuickChanges() throws Exception {
        reportMissing("why");
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                status("running", "[{'id':'t','reason':'why'},{'id':'u','reason':'why'}]", "'t and u'"));
        farm.pass(Duration.ofSeconds(11));
        JsonNode newest = farm.newest(Topics.ALARMS);
        assertThat(newest.path("text").asText()).isEqualTo("mission m: t and u");
        assertThat(newest.path("change").asText()).isEqualTo("updated");
    }

    private void reportMissing(String why) {
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                status("starting", "[{'id':'t','reason':'%s'}]".formatted(why), "'t (%s)'".formatted(why)));
    }

    private static String status(String state, String missing, String reason) {
        return ("{'mission':'m','domain':'d','state':'%s','since':1,'sequence':1,'devices':2,'confirmed':1,'missing':%s,'reason':%s}")
                .formatted(state, missing, reason);
    }

    private long countClosedClockAlarms() throws Exception {
        return farm.all(Topics.ALARMS).stream()
                .filter(alarm -> alarm.path("kind").asText().equals("clock-behind"))
                .filter(alarm -> alarm.path("state").asText().equals("closed"))
                .count();
    }

    @Test
    void executesCommands() throws Exception {
        farm.encounter("started", 3.2);
        farm.newest(Topics.ALARMS);
        farm.request(
                Topics.ALARM_MANAGER, "'requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'");
        farm.request(
                Topics.ALARM_MANAGER, "'requestId':'r','command':'acknowledge','alarm':'collision-1','user':'ann'");
        farm.request(Topics.ALARM_MANAGER, "'command':'mute','kind':'collision','for':'PT1H'");
        farm.request(Topics.ALARM_MANAGER, "'command':'close','alarm':'collision-9'");

        assertThat(farm.all(Topics.ALARM_MANAGER))
                .extracting(each -> each.path("status").asText())
                .containsExactly("acknowledged", "muted", "error");
        List<JsonNode> alarms = farm.all(Topics.ALARMS);
        assertThat(alarms.get(0).path("acknowledgedBy").asText()).isEqualTo("ann");
        assertThat(alarms.get(1).path("mutedUntil").asLong())
                .isEqualTo(farm.now().plus(Duration.ofHours(1)).toEpochMilli());
    }

    @Test
    void writesOneDeadLetterPerUnreadableRecord() {
        farm.pipe(Topics.COLLISION, "a-b", "{}".getBytes(UTF_8));
        farm.pipe(Topics.TEMPERATURE, "f", "[".getBytes(UTF_8));
        farm.pipe(Topics.RAW, "x", "[".getBytes(UTF_8));
        farm.pipe(Topics.DEVICES, "|/|x", "[".getBytes(UTF_8));
        farm.pipe(Topics.RAW, "x", "[".getBytes(UTF_8));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.encounter("started", 3.2);
        assertThat(farm.read(Topics.ALARMS)).hasSize(1);

        assertThat(farm.read(Topics.dead(Topics.COLLISION)))
                .singleElement()
                .satisfies(deadLetter ->
                        assertThat(header(deadLetter, DeadLetter.SOURCE)).isEqualTo("data.collision-0@0"));
        assertThat(farm.read(Topics.dead(Topics.TEMPERATURE))).hasSize(1);
    }

    /** An internal topic would reject such a record, and processing would stop. */
    @Test
    void writesDeadLettersForOversizedRecords() {
        farm.pipe(Topics.COLLISION, "a-b", new byte[Limits.RECORD_BYTES]);
        farm.pipe(Topics.TEMPERATURE, "x".repeat(Limits.RECORD_BYTES), "{}");
        farm.encounter("started", 3.2);

        assertThat(farm.read(Topics.ALARMS)).hasSize(1);
        for (String topic : List.of(Topics.COLLISION, Topics.TEMPERATURE)) {
            assertThat(farm.read(Topics.dead(topic)))
                    .singleElement()
                    .satisfies(deadLetter ->
                            assertThat(header(deadLetter, DeadLetter.REASON)).isEqualTo("too-large"));
        }
    }

    private static String header(TestRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }

    /** State and offsets are found by these names. */
    @Test
    void namesEveryStoreAndInternalTopic() {
        assertThat(WatchTopology.of(REQUEST_RETENTION, WatchOptions.DEFAULT, FiwareScope.DEFAULT)
                        .describe()
                        .toString())
                .doesNotContain("-0000")
                .contains("""
                                alarm-requests-repartition device-heartbeats-repartition collisions-repartition
                                temperatures-repartition clocks-repartition faults-repartition
                                context-domains-repartition context-missions-repartition
                                context-mission-statuses-repartition""".split("\\s+"));
        assertThat(farm.stores()).isEqualTo(Set.of("""
                                alarms current-alarms alarm-mutes alarm-sequence alarm-groups alarm-overflow
                                alarm-responses alarm-positions collisions-positions temperatures-positions suspect-streaks
                                clocks-positions faults-positions desired-devices device-connections device-health
                                context-domains-positions context-missions-positions
                                context-mission-statuses-positions context-domains context-missions context-statuses
                                context-tallies context-fields context-outdated context-reported""".split("\\s+")));
    }
}
