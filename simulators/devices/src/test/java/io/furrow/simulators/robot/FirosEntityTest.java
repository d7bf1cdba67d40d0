package io.furrow.simulators.robot;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class FirosEntityTest {
    private static final Instant START = Instant.parse("2026-06-01T08:00:00Z");
    private static final RobotModel ROBOT = new RobotModel(
            "robot-1",
            Trajectory.along(
                    List.of(new Position(40.31, -3.48), new Position(40.32, -3.48)), new Trajectory.Pace(1.5, 45)),
            0,
            Duration.ZERO);

    @Test
    void reportsItsPositionTimeSpeedAndHeading() {
        Entity entity = entity(RobotState.starting(START, 20));

        assertThat(entity.type()).isEqualTo("ROBOT");
        assertThat(PositionReading.of(entity).usable()).hasValueSatisfying(place -> {
            assertThat((place.latitude() - 40.31) * 111_194.9).isEqualTo(30, within(0.01));
            assertThat(place.longitude()).isEqualTo(-3.48);
        });
        assertThat(entity.number("Time")).contains((double) START.toEpochMilli());
        assertThat(entity.number("speed")).contains(1.5);
        assertThat(entity.number("heading")).contains(0d);
    }

    @Test
    void writesRosMessagesAsTextWithoutQuotes() throws Exception {
        Entity entity = entity(RobotState.starting(START, 4 * 3600).commanded(true));

        for (String message : List.of("gnss", "state", "battery")) {
            assertThat(entity.text(message))
                    .hasValueSatisfying(text ->
                            assertThat(text).contains("%27").doesNotContain("'").doesNotContain("\""));
        }
        assertThat(message(entity, "state").path("data").textValue()).isEqualTo("Stopped");
        assertThat(message(entity, "battery").path("percentage").doubleValue()).isEqualTo(0.6);
        assertThat(entity.number("speed")).contains(0d);
    }

    @Test
    void losesBatteryLevelWithWhatItDrives() {
        assertThat(FirosEntity.batteryLevel(0)).isEqualTo(1);
        assertThat(FirosEntity.batteryLevel(7.999 * 3600)).isEqualTo(0.2, within(0.001));
        assertThat(FirosEntity.batteryLevel(8 * 3600)).isEqualTo(1);
    }

    private static Entity entity(RobotState state) {
        return FirosEntity.of("urn:ngsi-ld:Robot:1", ROBOT, state).build();
    }

    private static JsonNode message(Entity entity, String attribute) throws Exception {
        return NgsiJson.mapper().readTree(entity.text(attribute).orElseThrow().replace("%27", "\""));
    }
}
