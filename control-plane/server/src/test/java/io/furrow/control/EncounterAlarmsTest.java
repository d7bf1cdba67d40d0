package io.furrow.control;

import java.time.Duration;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class EncounterAlarmsTest {
    @AutoClose
    private final FarmWatchFixture farm = new FarmWatchFixture();

    @Test
    void raisesACollisionAgainThatWasClosedManually() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofMinutes(2));
        farm.request(Topics.ALARM_MANAGER, "'command':'close','alarm':'collision-1'");
        assertThat(farm.newest(Topics.ALARMS).path("state").asText()).isEqualTo("closed");
        farm.encounter("ongoing", 3.2);
        JsonNode repeated = farm.newest(Topics.ALARMS);
        assertThat(repeated.path("state").asText()).isEqualTo("open");
        farm.pipe(
                Topics.ALARM_MANAGER,
                null,
                "{'type':'request','command':'close','alarm':'%s'}"
                        .formatted(repeated.path("alarm").asText()));
        assertThat(farm.newest(Topics.ALARM_MANAGER).path("error").asText()).isEqualTo("wrong-state");
        assertThat(farm.read(Topics.ALARMS)).isEmpty();
    }

    @Test
    void raisesAnAlarmUntilTheCollisionHasEnded() throws Exception {
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

    /** Devices near the distance threshold must not cause an alarm per report. */
    @Test
    void raisesOneAlarmForAPairNearTheThreshold() throws Exception {
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
    void endsOnlyTheCollisionOfTheSameTenant() throws Exception {
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

    /** The same ids and types may also meet within the first tenant. */
    @Test
    void raisesAnAlarmForDevicesOfTwoTenants() throws Exception {
        EntityBuilder within = Entity.builder("Analytics:Collision:1", "Analytics:Collision")
                .text("encounter", "e-1")
                .text("phase", "started")
                .text("Device1_ID", "r1")
                .text("Device1_type", "ROBOT")
                .text("Device2_ID", "r2")
                .text("Device2_type", "Camera");
        farm.pipe(Topics.COLLISION, "farm", "r1-r2", within.toBytes());
        farm.all(Topics.ALARMS);
        EntityBuilder across =
                within.text("encounter", "e-2").text("Device2_service", "other").text("Device2_servicePath", "/");
        farm.pipe(Topics.COLLISION, "farm", "r1-r2", across.toBytes());
        JsonNode alarm = farm.newest(Topics.ALARMS);
        assertThat(alarm.path("count").asInt()).isEqualTo(1);
        assertThat(alarm.path("identity").asText()).isEqualTo("farm|/|ROBOT other%7C/%7CCamera|r1-r2");
        assertThat(alarm.path("devices"))
                .extracting(device -> device.path("service").asText())
                .containsExactly("farm", "other");
    }

    @Test
    void saysTheSmallestDistanceOfAllItsEncounters() throws Exception {
        farm.encounter("started", 4.7);
        farm.encounter("ongoing", 3.2);
        farm.encounter("ended", 3.0);
        List<JsonNode> all = farm.all(Topics.ALARMS);
        assertThat(all)
                .extracting(alarm -> alarm.path("text").asText().replaceAll(".* came", "came"))
                .containsExactly("came within 4.7 m", "came within 3.0 m");
        assertThat(all.get(1).at("/values/meters").asDouble()).isEqualTo(3.0);
        assertThat(all.get(1).path("sequence")).isEqualTo(all.get(0).path("sequence"));

        farm.encounter("started", 4.8);
        farm.encounter("ended", 4.5);
        assertThat(farm.newest(Topics.ALARMS).at("/values/meters").asDouble()).isEqualTo(3.0);
    }

    @Test
    void endsACollisionWhoseEndWasLost() throws Exception {
        farm.encounter("started", 3.2);
        farm.pass(Duration.ofMinutes(50));
        farm.encounter("ongoing", 3.2);
        farm.pass(Duration.ofMinutes(50));
        JsonNode open = farm.newest(Topics.ALARMS);
        assertThat(open.path("state").asText()).isEqualTo("open");
        assertThat(open.at("/values/meters").asDouble()).isEqualTo(3.2);
        farm.pass(Duration.ofMinutes(11));
        JsonNode closed = farm.newest(Topics.ALARMS);
        assertThat(closed.path("state").asText()).isEqualTo("closed");
        assertThat(closed.path("reason").asText())
                .isEqualTo("no report of the encounter for 60 min, not even of its end");
    }
}
