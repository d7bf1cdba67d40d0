package io.furrow.simulators.device;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.io.InputStream;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Position;
import io.furrow.simulators.device.DevicePlan.CameraPlan;
import io.furrow.simulators.device.DevicePlan.RobotPlan;
import io.furrow.simulators.device.DevicePlan.ThermometerPlan;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DemoScenarioTest {
    private static final double CLOSE_METERS = 5;
    private static final Instant NOON = Instant.parse("2026-06-01T12:00:00Z");

    private final Scenario demo = Scenario.demo();

    @Test
    void hasTheFarmWithTwoMissionsAndTheCanary() {
        assertThat(demo.domains()).extracting(Scenario.Domain::name).containsExactly("farm", "canary");
        assertThat(demo.domains().get(0).missions())
                .extracting(Scenario.Mission::name)
                .containsExactly("weeding", "scouting");
        assertThat(demo.domains().get(1).missions())
                .extracting(Scenario.Mission::name)
                .containsExactly("dummy");
    }

    @Test
    void putsFourOneAndOneThermometersIntoTheFieldsTheyName() throws IOException {
        Map<String, Integer> counts = new TreeMap<>();
        for (ThermometerPlan plan : devices("farm", ThermometerPlan.class)) {
            List<String> fields = fieldsAt(plan.route().points().get(0));
            assertThat(fields).as(plan.id()).containsExactly(plan.route().where());
            counts.merge(fields.get(0), 1, Integer::sum);
        }

        assertThat(counts).isEqualTo(Map.of("field-1", 4, "field-2", 1, "field-3", 1));
    }

    @Test
    void keepsTheCanaryOutOfTheFields() throws IOException {
        for (ThermometerPlan plan : devices("canary", ThermometerPlan.class)) {
            assertThat(fieldsAt(plan.route().points().get(0))).as(plan.id()).isEmpty();
        }
        assertThat(devices("canary", ThermometerPlan.class)).hasSize(3);
        assertThat(devices("canary", RobotPlan.class)).hasSize(1);
        assertThat(devices("canary", CameraPlan.class))
                .singleElement()
                .satisfies(camera -> assertThat(camera.route().path().at(Duration.ofSeconds(30)))
                        .isNotEqualTo(camera.route().path().at(Duration.ZERO)));
    }

    @Test
    void hasOneDefectiveThermometerFarFromItsThreeNeighbours() {
        List<Double> shown = devices("farm", ThermometerPlan.class).stream()
                .filter(plan -> plan.route().where().equals("field-1"))
                .map(plan -> Thermometer.of(plan).temperature().at(NOON))
                .sorted()
                .toList();

        assertThat(shown.get(2) - shown.get(0)).isLessThan(2);
        assertThat(shown.get(3) - shown.get(2)).isGreaterThan(20);
    }

    @Test
    void letsTheTwoRobotsMeetWithinTenSecondsAndThenEveryTwentyToThirty() {
        List<RobotPlan> robots = devices("farm", RobotPlan.class);
        assertThat(robots)
                .hasSize(2)
                .allSatisfy(robot -> assertThat(robot.periodMs()).isEqualTo(500));
        List<Duration> meetings =
                meetings(robots.get(0).route().path(), robots.get(1).route().path());

        assertThat(meetings.get(0)).isLessThan(Duration.ofSeconds(10));
        assertThat(meetings).hasSizeGreaterThan(20);
        for (int i = 1; i < meetings.size(); i++) {
            assertThat(meetings.get(i).minus(meetings.get(i - 1)))
                    .isBetween(Duration.ofSeconds(20), Duration.ofSeconds(30));
        }
    }

    @Test
    void keepsAllOthersApart() {
        List<DevicePlan> devices = devices("", DevicePlan.class);
        for (int second = 0; second < 600; second++) {
            for (int a = 0; a < devices.size(); a++) {
                for (int b = a + 1; b < devices.size(); b++) {
                    if (!(devices.get(a).id().equals("robot-1")
                            && devices.get(b).id().equals("robot-2"))) {
                        Duration time = Duration.ofSeconds(second);
                        assertThat(Path.meters(
                                        devices.get(a).route().path().at(time),
                                        devices.get(b).route().path().at(time)))
                                .as(devices.get(a).id() + " and "
                                        + devices.get(b).id())
                                .isGreaterThan(3 * CLOSE_METERS);
                    }
                }
            }
        }
    }

    @Test
    void givesEachDeviceAnIdAndAnEntityOfItsOwn() {
        assertThat(devices("", DevicePlan.class))
                .hasSize(14)
                .extracting(DevicePlan::id)
                .doesNotHaveDuplicates();
        assertThat(devices("", DevicePlan.class)).extracting(DevicePlan::entity).doesNotHaveDuplicates();
    }

    @Test
    void refusesAMemberItDoesNotKnow() {
        byte[] json = "{\"apiKey\":\"k\",\"domains\":[],\"colour\":1}".getBytes(StandardCharsets.UTF_8);

        assertThatThrownBy(() -> Scenario.read(new ByteArrayInputStream(json)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("colour");
    }

    /** The times at which a pair becomes close, seen at 2 Hz over ten minutes. */
    private static List<Duration> meetings(Path a, Path b) {
        List<Duration> meetings = new ArrayList<>();
        boolean close = false;
        for (int beat = 0; beat < 1200; beat++) {
            Duration time = Duration.ofMillis(500L * beat);
            boolean now = Path.meters(a.at(time), b.at(time)) <= CLOSE_METERS;
            if (now && !close) {
                meetings.add(time);
            }
            close = now;
        }
        return meetings;
    }

    private <T extends DevicePlan> List<T> devices(String domain, Class<T> type) {
        return demo.assignments().stream()
                .filter(assignment -> domain.isEmpty() || assignment.domain().equals(domain))
                .map(Scenario.Assignment::device)
                .filter(type::isInstance)
                .map(type::cast)
                .toList();
    }

    private static List<String> fieldsAt(Position place) throws IOException {
        List<String> fields = new ArrayList<>();
        try (InputStream geojson = Scenario.class.getResourceAsStream(Scenario.DEMO_FIELDS)) {
            for (JsonNode field : NgsiJson.mapper().readTree(geojson).path("features")) {
                if (inside(field.at("/geometry/coordinates/0"), place)) {
                    assertThat(field.at("/properties/Domain").textValue()).isEqualTo("farm");
                    assertThat(field.at("/properties/name").textValue()).isNotBlank();
                    fields.add(field.path("id").textValue());
                }
            }
        }
        return fields;
    }

    /** Inside when a ray to the east crosses the ring an odd number of times. */
    private static boolean inside(JsonNode ring, Position place) {
        boolean inside = false;
        for (int i = 1; i < ring.size(); i++) {
            double lonA = ring.get(i - 1).get(0).doubleValue();
            double latA = ring.get(i - 1).get(1).doubleValue();
            double lonB = ring.get(i).get(0).doubleValue();
            double latB = ring.get(i).get(1).doubleValue();
            if (latA > place.latitude() != latB > place.latitude()
                    && place.longitude() < lonA + (place.latitude() - latA) / (latB - latA) * (lonB - lonA)) {
                inside = !inside;
            }
        }
        return inside;
    }
}
