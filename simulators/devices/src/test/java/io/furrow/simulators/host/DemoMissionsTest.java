package io.furrow.simulators.host;

import java.io.IOException;
import java.io.InputStream;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Predicate;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.Position;
import io.furrow.simulators.robot.Activity;
import io.furrow.simulators.robot.RobotModel;
import io.furrow.simulators.robot.RobotState;
import io.furrow.simulators.robot.Trajectory;
import io.furrow.simulators.scenario.DesiredDeviceReader;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Camera;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

import static org.assertj.core.api.Assertions.assertThat;

/** What {@code ./furrow demo} shows, device by device as a host makes them. */
class DemoMissionsTest {
    private static final double CLOSE_METERS = 5;
    private static final double METERS_PER_DEGREE = 111_195;
    private static final Instant NOON = Instant.parse("2026-06-01T12:00:00Z");

    private final Map<String, SimulatedDevice> devices = new LinkedHashMap<>();
    private JsonNode demo;

    @BeforeEach
    void make() throws Exception {
        demo = resource("missions.json");
        DesiredDeviceReader reader = new DesiredDeviceReader(Map.of(), 0);
        for (JsonNode mission : demo.path("missions")) {
            for (JsonNode template : demo.path("templates")) {
                if (template.path("template").equals(mission.path("template"))) {
                    for (JsonNode device : template.path("devices")) {
                        devices.put(device.path("id").asText(), reader.read(desired(mission, device)));
                    }
                }
            }
        }
    }

    @Test
    void hasTheFarmWithTwoMissionsAndTheCanary() {
        assertThat(demo.path("domains").findValuesAsText("domain")).containsExactly("farm", "canary");
        assertThat(demo.path("missions").findValuesAsText("mission")).containsExactly("weeding", "scouting", "dummy");
        assertThat(devices).hasSize(17);
    }

    @Test
    void putsFourThreeAndOneThermometersIntoTheFieldsTheyName() throws IOException {
        Map<String, Integer> counts = new TreeMap<>();
        for (Sensor sensor : thermometers()) {
            List<String> fields = fieldsAt(place(sensor, Duration.ZERO));
            assertThat(fields).as(sensor.id()).containsExactly(sensor.place().where());
            counts.merge(fields.get(0), 1, Integer::sum);
        }

        assertThat(counts).isEqualTo(Map.of("field-1", 4, "field-2", 3, "field-3", 1));
    }

    /** A yard with a sensor in it would have an average. */
    @Test
    void excludesWeatherStationAndCameraFromFieldsAndYard() throws IOException {
        for (SimulatedDevice device :
                List.of(devices.get("urn:ngsi-ld:WeatherStation:1"), devices.get("urn:ngsi-ld:Camera:1"))) {
            assertThat(fieldsAt(place(device, Duration.ZERO))).as(device.id()).isEmpty();
        }
    }

    /** The map draws the rows from the field's properties: they have to be those that the robots work. */
    @Test
    void letsTheRobotsWorkAlongTheRowsOfTheUpperField() throws IOException {
        JsonNode field = resource("fields.geojson").at("/features/0");
        double rows = field.at("/properties/rowDirection").doubleValue();
        assertThat(field.at("/properties/rowSpacing").doubleValue()).isEqualTo(3);
        for (Robot robot : robots()) {
            int along = 0;
            for (int second = 0; second < 600; second++) {
                Trajectory.Pose pose = robot.model().way().at(second);
                assertThat(fieldsAt(pose.place())).as(robot.id()).containsExactly("field-1");
                double off = Math.abs((pose.heading() - rows + 270) % 180 - 90);
                along += off < 1 ? 1 : 0;
            }
            assertThat(along)
                    .as(robot.id() + ": seconds along the rows of ten minutes")
                    .isGreaterThan(400);
        }
    }

    @Test
    void excludesTheCanaryFromTheFields() throws IOException {
        for (Sensor sensor : of("canary", Sensor.class)) {
            assertThat(fieldsAt(place(sensor, Duration.ZERO))).as(sensor.id()).isEmpty();
        }
        assertThat(of("canary", Sensor.class)).hasSize(3);
        assertThat(of("canary", Robot.class)).hasSize(1);
        assertThat(of("canary", Camera.class))
                .singleElement()
                .satisfies(camera ->
                        assertThat(place(camera, Duration.ofSeconds(30))).isNotEqualTo(place(camera, Duration.ZERO)));
    }

    @Test
    void hasOneDefectiveThermometerFarFromItsThreeNeighbours() {
        List<Double> shown = of("farm", Sensor.class).stream()
                .filter(sensor -> sensor.place().where().equals("field-1"))
                .map(sensor -> sensor.quantities().get(0).signal().at(NOON).orElseThrow())
                .sorted()
                .toList();

        assertThat(shown.get(2) - shown.get(0)).isLessThan(2);
        assertThat(shown.get(3) - shown.get(2)).isGreaterThan(20);
    }

    /** A host starts them one after the other. */
    @ParameterizedTest
    @ValueSource(ints = {0, 1, 2, 3})
    void letsTheTwoRobotsMeetWithinTenSecondsAndThenEveryTwentyToThirtyFive(int secondsBetweenStarts) {
        assertThat(robots())
                .hasSize(2)
                .allSatisfy(robot -> assertThat(robot.period()).isEqualTo(Duration.ofMillis(500)));
        List<Beat> beats = work(Duration.ofSeconds(secondsBetweenStarts), Duration.ofHours(1));
        List<Duration> encounters = starts(beats, beat -> beat.meters() <= CLOSE_METERS);

        assertThat(encounters.get(0)).isLessThan(Duration.ofSeconds(10));
        assertThat(encounters).hasSizeGreaterThan(100);
        for (int i = 1; i < encounters.size(); i++) {
            assertThat(encounters.get(i).minus(encounters.get(i - 1)))
                    .isBetween(Duration.ofSeconds(20), Duration.ofSeconds(35));
        }
        assertThat(beats).allSatisfy(beat -> assertThat(beat.meters()).isGreaterThan(2));
    }

    @Test
    void letsTheSecondRobotStopForTheFirstAndGoOn() {
        List<Beat> beats = work(Duration.ZERO, Duration.ofHours(1));
        int encounters = starts(beats, beat -> beat.meters() <= CLOSE_METERS).size();

        assertThat(starts(beats, beat -> beat.second() == Activity.WAITING))
                .hasSizeBetween(encounters - 1, encounters + 1);
        assertThat(starts(beats, beat -> beat.first() == Activity.WAITING)).isEmpty();
        assertThat(beats.stream()
                        .filter(beat -> beat.second() == Activity.RUNNING)
                        .count())
                .as("beats in which the second one goes")
                .isGreaterThan(beats.size() / 2);
    }

    @Test
    void separatesAllOthers() {
        List<SimulatedDevice> all = List.copyOf(devices.values());
        for (int second = 0; second < 600; second++) {
            Duration time = Duration.ofSeconds(second);
            for (int a = 0; a < all.size(); a++) {
                for (int b = a + 1; b < all.size(); b++) {
                    boolean meet = all.get(a).id().equals("urn:ngsi-ld:Robot:1")
                            && all.get(b).id().equals("urn:ngsi-ld:Robot:2");
                    if (!meet) {
                        assertThat(meters(place(all.get(a), time), place(all.get(b), time)))
                                .as(all.get(a).id() + " and " + all.get(b).id())
                                .isGreaterThan(3 * CLOSE_METERS);
                    }
                }
            }
        }
    }

    private record Beat(Duration time, double meters, Activity first, Activity second) {}

    /** The two robots at 2 Hz, each seeing the other; the first has started earlier. */
    private List<Beat> work(Duration earlier, Duration length) {
        Robot first = robots().get(0);
        Robot second = robots().get(1);
        Instant start = NOON;
        RobotState one = RobotState.starting(start, first.driven() + earlier.toSeconds());
        RobotState other = RobotState.starting(start, second.driven());
        List<Beat> beats = new ArrayList<>();
        for (Duration time = Duration.ZERO; time.compareTo(length) < 0; time = time.plusMillis(500)) {
            Instant now = start.plus(time);
            one = first.model().advance(one, now, around(second, other));
            other = second.model().advance(other, now, around(first, one));
            double meters = meters(
                    first.model().pose(one).place(), second.model().pose(other).place());
            beats.add(new Beat(time, meters, one.activity(), other.activity()));
        }
        return beats;
    }

    private static Map<String, Position> around(Robot robot, RobotState state) {
        return Map.of(robot.id(), robot.model().pose(state).place());
    }

    private static List<Duration> starts(List<Beat> beats, Predicate<Beat> condition) {
        List<Duration> starts = new ArrayList<>();
        boolean before = false;
        for (Beat beat : beats) {
            boolean now = condition.test(beat);
            if (now && !before) {
                starts.add(beat.time());
            }
            before = now;
        }
        return starts;
    }

    private List<Robot> robots() {
        return of("farm", Robot.class);
    }

    private List<Sensor> thermometers() {
        return of("farm", Sensor.class).stream()
                .filter(sensor -> sensor.identity().type().equals("Thermometer"))
                .toList();
    }

    private static Position place(SimulatedDevice device, Duration time) {
        double seconds = time.toMillis() / 1000.0;
        if (device instanceof Robot robot) {
            RobotModel model = robot.model();
            return model.way().at(robot.driven() + seconds).place();
        }
        Trajectory way = device instanceof Sensor sensor
                ? sensor.place().way()
                : ((Camera) device).place().way();
        return way.at(seconds).place();
    }

    private <T extends SimulatedDevice> List<T> of(String domain, Class<T> type) {
        return devices.values().stream()
                .filter(device -> device.identity().domain().equals(domain))
                .filter(type::isInstance)
                .map(type::cast)
                .toList();
    }

    private static DesiredDevice desired(JsonNode mission, JsonNode device) {
        DeviceVersion version = new DeviceVersion(
                device.path("id").asText(),
                "farm",
                "/",
                mission.path("domain").asText(),
                mission.path("mission").asText(),
                NOON.toEpochMilli(),
                null,
                1,
                null);
        ObjectNode settings = device.deepCopy();
        settings.retain("area", "path", "speed", "faults", "parameters");
        return DesiredDevice.simulated(
                version,
                device.path("type").asText(),
                version.id(),
                true,
                Duration.parse(device.path("period").asText()),
                settings);
    }

    private static JsonNode resource(String name) throws IOException {
        try (InputStream json = DeviceHost.class.getResourceAsStream("/io/furrow/simulators/demo/" + name)) {
            return NgsiJson.mapper().readTree(json);
        }
    }

    private static double meters(Position a, Position b) {
        double north = (a.latitude() - b.latitude()) * METERS_PER_DEGREE;
        double east = (a.longitude() - b.longitude())
                * METERS_PER_DEGREE
                * Math.cos(Math.toRadians((a.latitude() + b.latitude()) / 2));
        return Math.hypot(north, east);
    }

    private static List<String> fieldsAt(Position place) throws IOException {
        List<String> fields = new ArrayList<>();
        for (JsonNode field : resource("fields.geojson").path("features")) {
            if (inside(field.at("/geometry/coordinates/0"), place)) {
                assertThat(field.at("/properties/Domain").textValue()).isEqualTo("farm");
                fields.add(field.path("id").textValue());
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
