package io.furrow.simulators.device;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.model.event.EventTime;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.PositionReading;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class RobotTest {
    private static final Instant START = Instant.parse("2026-06-01T12:00:00Z");
    private static final Route ROUTE =
            new Route("field-2", List.of(new Position(40.31, -3.48), new Position(40.32, -3.48)), 1.5, 0);

    @Test
    void tellsItsPositionAsFirosDoes() {
        Entity entity = robot(true).entity(START.plusSeconds(20));

        assertThat(entity.type()).isEqualTo("ROBOT");
        assertThat(entity.text("gnss"))
                .hasValueSatisfying(text -> assertThat(text)
                        .contains("%27latitude%27")
                        .doesNotContain("'")
                        .doesNotContain("\""));
        assertThat(PositionReading.of(entity).usable()).hasValueSatisfying(place -> {
            assertThat(Path.meters(new Position(40.31, -3.48), place)).isEqualTo(30, within(0.01));
            assertThat(place.longitude()).isEqualTo(-3.48);
        });
    }

    @Test
    void tellsItsOwnTime() {
        Instant now = START.plusMillis(1_234);

        assertThat(EventTime.of(robot(true).entity(now), START.plusSeconds(60), Duration.ofMinutes(5)))
                .isEqualTo(new EventTime(now, EventTime.Basis.DEVICE));
    }

    @Test
    void carriesDomainAndMissionOnlyWhenToldTo() {
        assertThat(robot(true).entity(START).text("Domain")).contains("farm");
        assertThat(robot(true).entity(START).text("Mission")).contains("weeding");
        assertThat(robot(false).entity(START).value("Domain")).isEmpty();
        assertThat(robot(false).entity(START).value("Mission")).isEmpty();
    }

    private static Robot robot(boolean tellsMission) {
        DevicePlan plan = new DevicePlan.RobotPlan("robot-1", "urn:ngsi-ld:Robot:1", ROUTE, 500, tellsMission);
        return new Robot(null, null, new Scenario.Assignment("farm", "weeding", plan), START);
    }
}
