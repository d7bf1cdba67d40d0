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
import io.furrow.model.topic.Topics;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class WatchTopologyTest {
    private static final Duration REMEMBERED = Duration.ofHours(1);
    private static final Duration WINDOW = Duration.ofSeconds(30);
    private static final String THERMOMETER = "urn:ngsi-ld:Thermometer:m-1";

    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void publishesWhenADeviceWasLastSeenAndHowFullItsBatteryIs() throws Exception {
        farm.addDesired(THERMOMETER, "Thermometer", true);
        farm.pass(Duration.ofSeconds(1));
        farm.report(Entity.builder(THERMOMETER, "Thermometer").number("battery", 81.5));

        JsonNode health = farm.newest(Topics.DEVICES_HEALTH);
        assertThat(health.path("lastSeen").asLong()).isEqualTo(farm.now().toEpochMilli());
        assertThat(health.path("battery").asDouble()).isEqualTo(0.815);
        assertThat(health.path("silent").asBoolean(true)).isFalse();
        assertThat(health.path("mission").asText()).isEqualTo("m");
    }

    /** Of a clock that is far ahead the event time is that of the receipt, which says nothing of the clock. */
    @Test
    void publishesTheTimeThatADeviceItselfGave() throws Exception {
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
    void raisesACollisionAnewThatWasClosedByHandWhileTheEncounterLasts() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofMinutes(2));
        farm.request(Topics.ALARM_MANAGER, "'command':'close','alarm':'collision-1'");
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
        farm.addDesired(FarmWatchFixture.ROBOT, null, true);
        farm.report(Entity.builder(FarmWatchFixture.ROBOT, "ROBOT"));
        farm.encounter("predicted", 3.2);
        JsonNode predicted = farm.newest(Topics.ALARMS);
        assertThat(predicted.path("kind").asText()).isEqualTo("predicted-encounter");
        assertThat(predicted.at("/devices/0/type").asText()).isEqualTo("ROBOT");
        farm.encounter("predicted", 3.2);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.encounter("started", 3.2);
        List<JsonNode> both = farm.all(Topics.ALARMS);
        assertThat(both).extracting(each -> each.path("state").asText()).containsExactly("closed", "open");
        assertThat(both.get(1).path("severity").asText()).isEqualTo("critical");
        farm.encounter("ongoing", 3.2);
        farm.encounter("ended", 3.2);
        farm.pass(Duration.ofSeconds(29));
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        farm.pass(Duration.ofSeconds(1));
        JsonNode closed = farm.newest(Topics.ALARMS);
        assertThat(closed.path("state").asText()).isEqualTo("closed");
        assertThat(closed.path("count").asInt()).as("encounters").isEqualTo(1);
        assertThat(closed.path("reason").asText())
                .isEqualTo("the encounter has ended, and the pair has had no other since");
    }

    /** Devices at the border of what is close: whoever is notified of alarms hears of one. */
    @Test
    void raisesOneAlarmOfAPairThatComesCloseAgainAndAgain() throws Exception {
        for (int i = 0; i < 12; i++) {
            farm.encounter("predicted", 4.8);
            farm.encounter("started", 4.8);
            farm.encounter("ended", 5.2);
            farm.pass(Duration.ofSeconds(29));
        }
        List<JsonNode> open = farm.all(Topics.ALARMS).stream()
                .filter(alarm -> alarm.path("kind").asText().equals("collision"))
                .toList();
        assertThat(open).extracting(alarm -> alarm.path("sequence").asLong()).containsOnly(3L);
        assertThat(open.get(open.size() - 1).path("count").asInt()).isEqualTo(12);
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.all(Topics.ALARMS)).singleElement().satisfies(closed -> {
            assertThat(closed.path("state").asText()).isEqualTo("closed");
            assertThat(closed.path("count").asInt()).isEqualTo(12);
        });
        farm.encounter("predicted", 4.8);
        assertThat(farm.newest(Topics.ALARMS).path("kind").asText()).isEqualTo("predicted-encounter");
    }

    @Test
    void raisesAnAlarmOfASensorThatIsSetAsideInThreeWindowsInARowUntilItIsNotForThree() throws Exception {
        suspectFor(2);
        farm.temperature("f", 18, List.of());
        farm.pass(WINDOW);
        suspectFor(2);
        assertThat(farm.read(Topics.ALARMS)).as("never three in a row").isEmpty();
        farm.temperature("f", 18, List.of(THERMOMETER));
        assertThat(farm.newest(Topics.ALARMS).path("kind").asText()).isEqualTo("suspect-sensor");
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of());
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(Duration.ofSeconds(89));
        assertThat(farm.read(Topics.ALARMS)).as("one window makes it last").isEmpty();
        farm.pass(Duration.ofSeconds(1));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void countsAWindowOfASensorOnceAndNoneWithoutAVerdict() throws Exception {
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("f", 18, List.of(THERMOMETER));
        farm.temperature("g", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        suspectFor(1);
        farm.unverified("f");
        farm.pass(WINDOW);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
        suspectFor(1);
        assertThat(farm.all(Topics.ALARMS)).hasSize(1);
    }

    @Test
    void countsNoWindowAgainThatASoundOneHasFollowed() throws Exception {
        byte[] first = farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        byte[] second = farm.temperature("f", 18, List.of(THERMOMETER));
        farm.pass(WINDOW);
        farm.temperature("f", 18, List.of());
        farm.pipe(Topics.TEMPERATURE, "f", first);
        farm.pipe(Topics.TEMPERATURE, "f", second);
        farm.pass(WINDOW);
        suspectFor(2);
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
    }

    @Test
    void raisesAnAlarmOfADeviceWhosePositionsComeTooLate() throws Exception {
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
        assertThat(closedClocks()).isZero();
        farm.pass(Duration.ofSeconds(1));
        assertThat(closedClocks()).isEqualTo(1);
        farm.pipe(Topics.CLOCKS, "x", "{}".getBytes(UTF_8));
        assertThat(farm.read(Topics.dead(Topics.CLOCKS))).hasSize(1);
    }

    @Test
    void raisesAnAlarmOfEachDeviceOfOneId() throws Exception {
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
    void endsTheCollisionOfATenantAndNotThatOfAnother() throws Exception {
        for (String[] each : new String[][] {{"farm", "started"}, {"other", "started"}, {"other", "ended"}}) {
            EntityBuilder encounter = Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                    .text("encounter", "e")
                    .text("phase", each[1])
                    .text("Device1_ID", "r1")
                    .text("Device1_type", "ROBOT")
                    .text("Device2_ID", "r2")
                    .text("Device2_type", "Camera");
            farm.pipe(Topics.COLLISION, each[0], "r1-r2", encounter.toBytes());
        }
        assertThat(farm.all(Topics.ALARMS)).hasSize(2);
        farm.pass(Duration.ofSeconds(30));
        assertThat(farm.all(Topics.ALARMS)).singleElement().satisfies(closed -> {
            assertThat(closed.path("state").asText()).isEqualTo("closed");
            assertThat(closed.path("identity").asText()).isEqualTo("other|/|ROBOT Camera|r1-r2");
        });
    }

    @Test
    void countsTheWindowsOfSensorsOfOneIdAndTwoTypesEach() throws Exception {
        for (int window = 0; window < 4; window++) {
            farm.temperature("f", 18, List.of(THERMOMETER), List.of(window % 2 == 0 ? "Thermometer" : "Station"));
            farm.pass(WINDOW);
        }
        assertThat(farm.read(Topics.ALARMS)).as("never three in a row").isEmpty();
        for (int window = 0; window < 3; window++) {
            farm.temperature("f", 18, List.of(THERMOMETER, THERMOMETER), List.of("Station", "Thermometer"));
            farm.pass(WINDOW);
        }
        assertThat(farm.all(Topics.ALARMS))
                .extracting(alarm -> alarm.path("identity").asText())
                .containsExactlyInAnyOrder("farm|/|Station|" + THERMOMETER, "farm|/|Thermometer|" + THERMOMETER);
    }

    @Test
    void raisesTheSameForADeviceOfAnyKindThatIsFarBehind() throws Exception {
        farm.pipe(
                Topics.CLOCKS,
                "t",
                "{'id':'Analytics:ClockBehind:t','type':'Analytics:ClockBehind','device':{'value':'t'},"
                        + "'late':{'value':7200000},'reports':{'value':31},'Mission':{'value':''}}");
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("kind").asText()).isEqualTo("clock-behind");
        assertThat(alarm.path("text").asText())
                .isEqualTo("reports of t arrive 7200.0 s too late and are dropped: check its clock and its link");
    }

    @Test
    void endsACollisionWhoseEndWasLost() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofMinutes(50));
        farm.encounter("ongoing", 3.2);
        farm.pass(Duration.ofMinutes(50));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("open");
        farm.pass(Duration.ofMinutes(11));
        JsonNode closed = farm.newest(Topics.ALARMS);
        assertThat(closed.path("state").asText()).isEqualTo("closed");
        assertThat(closed.path("reason").asText())
                .isEqualTo("nothing was reported of the encounter for 60 min, not its end either");
    }

    @Test
    void raisesAnAlarmOfWhatDoesNotWorkInFurrowItselfWhileItIsRepeated() throws Exception {
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
    void namesTheDevicesThatAMissionMisses() throws Exception {
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
        farm.pipe(Topics.MISSIONS_STATUS, "m", status("running", "[]", "null"));
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
    }

    @Test
    void renewsTheWordsOfAnAlarmWithoutNotifyingAnew() throws Exception {
        misses("it has not connected");
        JsonNode raised = farm.newest(Topics.ALARMS);
        misses("its password was refused once");
        JsonNode reworded = farm.newest(Topics.ALARMS);
        assertThat(reworded.path("text").asText()).isEqualTo("mission m: t (its password was refused once)");
        assertThat(reworded.path("sequence")).isEqualTo(raised.path("sequence"));
        assertThat(reworded.path("change").asText()).isEqualTo("opened");
    }

    @Test
    void publishesEachExtentInTheEndThoughChangesFollowOneAnotherQuickly() throws Exception {
        misses("why");
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                status("running", "[{'id':'t','reason':'why'},{'id':'u','reason':'why'}]", "'t and u'"));
        farm.pass(Duration.ofSeconds(11));
        JsonNode newest = farm.newest(Topics.ALARMS);
        assertThat(newest.path("text").asText()).isEqualTo("mission m: t and u");
        assertThat(newest.path("change").asText()).isEqualTo("updated");
    }

    private void misses(String why) {
        farm.pipe(
                Topics.MISSIONS_STATUS,
                "m",
                status("starting", "[{'id':'t','reason':'%s'}]".formatted(why), "'t (%s)'".formatted(why)));
    }

    private static String status(String state, String missing, String reason) {
        return ("{'mission':'m','domain':'d','state':'%s','since':1,'sequence':1,'devices':2,'confirmed':1,'missing':%s,'reason':%s}")
                .formatted(state, missing, reason);
    }

    private long closedClocks() throws Exception {
        return farm.all(Topics.ALARMS).stream()
                .filter(alarm -> alarm.path("kind").asText().equals("clock-behind"))
                .filter(alarm -> alarm.path("state").asText().equals("closed"))
                .count();
    }

    private void suspectFor(int windows) {
        for (int i = 0; i < windows; i++) {
            farm.temperature("f", 18, List.of(THERMOMETER));
            farm.pass(WINDOW);
        }
    }

    @Test
    void answersWhatIsRequestedOfAlarms() throws Exception {
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
    void setsAsideWhatItCannotReadOnce() {
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
                    .satisfies(deadLetter ->
                            assertThat(header(deadLetter, DeadLetter.REASON)).isEqualTo("too-large"));
        }
    }

    private static String header(TestRecord<String, byte[]> record, String name) {
        return new String(record.headers().lastHeader(name).value(), UTF_8);
    }

    /** State and offsets are found by these names. */
    @Test
    void hasANameForEveryStoreAndEveryTopicOfItsOwn() {
        assertThat(WatchTopology.of(REMEMBERED, WatchOptions.DEFAULT, FiwareScope.DEFAULT)
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
