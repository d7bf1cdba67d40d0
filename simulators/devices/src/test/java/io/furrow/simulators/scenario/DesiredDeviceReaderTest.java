package io.furrow.simulators.scenario;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.Position;
import io.furrow.simulators.robot.WorkField;
import io.furrow.simulators.scenario.SimulatedDevice.Camera;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class DesiredDeviceReaderTest {
    private static final Instant FROM = Instant.parse("2026-06-01T08:00:00Z");
    private static final String SQUARE =
            "[[[-3.500, 40.300], [-3.499, 40.300], [-3.499, 40.301], [-3.500, 40.301], [-3.500, 40.300]]]";
    private static final String FAR = "[[[1, 2], [1.0001, 2], [1.0001, 2.0001], [1, 2]]]";

    private final DesiredDeviceReader reader = new DesiredDeviceReader(Map.of("orchard", orchard()), 7);

    @Test
    void drawsAPlaceInTheField() throws Exception {
        Sensor one = (Sensor) read("Thermometer", 1, "{\"area\": \"orchard\"}");
        Sensor two = (Sensor) read("Thermometer", 2, "{\"area\": \"orchard\"}");

        assertThat(orchard().covers(meters(one))).isTrue();
        assertThat(meters(one)).isNotEqualTo(meters(two));
        assertThat(meters((Sensor) read("Thermometer", 1, "{\"area\": \"orchard\"}")))
                .isEqualTo(meters(one));
        assertThat(one.period()).isEqualTo(Duration.ofSeconds(5));
        assertThat(one.identity().id()).isEqualTo("urn:ngsi-ld:Thermometer:m-1");
    }

    @Test
    void takesTheLargestPartOfADrawnArea() throws Exception {
        String area = "{\"type\": \"MultiPolygon\", \"coordinates\": [%s, %s]}".formatted(FAR, SQUARE);
        Sensor sensor = (Sensor) read("Thermometer", 1, "{\"area\": " + area + "}");

        assertThat(orchard().covers(meters(sensor))).isTrue();
    }

    @Test
    void letsARobotWorkAnAreaRowByRowOrGoAlongAPath() throws Exception {
        Robot rows = (Robot)
                read("Robot", 1, "{\"area\": \"orchard\", \"speed\": 2, \"parameters\": {\"rows\": {\"spacing\": 4}}}");
        Robot path = (Robot) read("Robot", 1, "{\"path\": [[-3.5, 40.3], [-3.5, 40.301]], \"speed\": 2}");

        assertThat(rows.model().way().lap()).isGreaterThan(path.model().way().lap());
        assertThat(rows.model().way().speed()).isEqualTo(2);
        assertThat(path.model().way().at(0).place().latitude()).isEqualTo(40.3);
    }

    @Test
    void hasABatteryWhereTheParametersReportSo() throws Exception {
        Sensor sensor = (Sensor) read("Thermometer", 1, "{\"path\": [[0, 0]], \"parameters\": {\"battery\": \"P7D\"}}");
        Camera camera = (Camera) read("Camera", 1, "{\"path\": [[0, 0]], \"parameters\": {\"battery\": \"P7D\"}}");

        assertThat(sensor.quantities())
                .extracting(each -> each.attribute().objectId())
                .containsExactly("temp", "bat");
        assertThat(camera.battery()).singleElement().satisfies(battery -> {
            assertThat(battery.attribute().name()).isEqualTo("battery");
            double now = battery.signal().at(FROM).orElseThrow();
            double dayLater = battery.signal().at(FROM.plus(Duration.ofDays(1))).orElseThrow();
            double weekLater =
                    battery.signal().at(FROM.plus(Duration.ofDays(7))).orElseThrow();
            assertThat(List.of(now, dayLater)).allMatch(level -> level >= 0.2 && level <= 1);
            assertThat(dayLater).isNotEqualTo(now);
            assertThat(weekLater).isEqualTo(now);
        });
    }

    @Test
    void countsFaultsFromWhenTheDeviceIsDesiredForTheNumberItsIdEndsIn() throws Exception {
        String settings =
                "{\"path\": [[0, 0]], \"faults\": [{\"kind\": \"silent\", \"after\": \"PT1M\", \"numbers\": [2]}]}";
        Sensor first = (Sensor) read("Thermometer", 1, settings);
        Sensor second = (Sensor) read("Thermometer", 2, settings);

        assertThat(first.quantities().get(0).signal().at(FROM.plusSeconds(60))).isPresent();
        assertThat(second.quantities().get(0).signal().at(FROM.plusSeconds(59))).isPresent();
        assertThat(second.quantities().get(0).signal().at(FROM.plusSeconds(60))).isEmpty();
    }

    @Test
    void measuresWhatATypeOfTheFarmsOwnSays() throws Exception {
        Sensor probe = (Sensor) read("SoilProbe", 1, """
                {"at": {"latitude": 0, "longitude": 0}, "attributes": [{"object_id": "m", "name": "Moisture", "unit": "P1", "low": 10, "high": 40}]}
                """);

        assertThat(probe.quantities()).singleElement().satisfies(moisture -> {
            assertThat(moisture.attribute().objectId()).isEqualTo("m");
            assertThat(moisture.attribute().name()).isEqualTo("Moisture");
            assertThat(moisture.signal().at(FROM).orElseThrow()).isBetween(10d, 40d);
        });
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', quoteCharacter = '`', textBlock = """
            Thermometer | {}                                                              | area: is missing; say where it is with one of at, area, path or carriedBy
            Robot       | {}                                                              | area: is missing; a robot needs an area, which it works row by row, or a path
            Robot       | {"carriedBy": "urn:r"}                                          | carriedBy: a robot goes by itself; leave it out
            Thermometer | {"area": "meadow"}                                              | area: there is no field 'meadow'; there are: orchard
            Thermometer | {"path": []}                                                    | path: has no point; give at least one [longitude, latitude]
            Thermometer | {"path": [[0, 0], [0, 1]], "speed": 0}                          | speed: must be a number from 0.01 to 50, not 0
            Thermometer | {"path": [[0, 0]], "parameters": {"meanCelsius": "warm"}}       | meanCelsius: must be a number from -60 to 60, not "warm"
            Thermometer | {"path": [[0, 0]], "parameters": {"period": "PT1S"}}            | parameters.period: is not a parameter; say it of the device itself
            Thermometer | {"path": [[0, 0]], "faults": [{"kind": "drift"}]}               | faults[0].perHour: must be a number from -1000000000 to 1000000000, and is missing
            Camera      | {"path": [[0, 0]], "parameters": {"battery": "two weeks"}}      | battery: must be a duration, for instance PT1S or PT10M, not "two weeks"
            Robot       | {"area": "orchard", "parameters": {"rows": {"margin": 90}}}     | rows: field 'orchard' has no room for a row 90.0 m from its edge: give a smaller margin
            Tractor     | {"path": [[0, 0]]}                                              | type: 'Tractor' is not a type of device; use Thermometer, WeatherStation, Camera or Robot
            """)
    void saysWhichSettingIsWrongAndWhatToDo(String type, String settings, String message) {
        assertThatThrownBy(() -> read(type, 1, settings))
                .isInstanceOf(InvalidScenarioException.class)
                .hasMessage(message);
    }

    private SimulatedDevice read(String type, int number, String settings) throws Exception {
        ObjectNode json = (ObjectNode) NgsiJson.mapper().readTree(settings);
        String carrier = json.hasNonNull("carriedBy") ? json.remove("carriedBy").asText() : null;
        String id = "urn:ngsi-ld:%s:m-%d".formatted(type, number);
        DeviceVersion version = new DeviceVersion(id, "farm", "/", "farm", "m", FROM.toEpochMilli(), null, 1, carrier);
        return reader.read(DesiredDevice.simulated(version, type, id, true, null, json));
    }

    private static org.locationtech.jts.geom.Coordinate meters(Sensor sensor) {
        Position place = sensor.place().way().at(0).place();
        return orchard().plane().toMeters(place);
    }

    private static WorkField orchard() {
        return Unchecked.get(() -> WorkField.largestOf(
                "orchard", NgsiJson.mapper().readTree("{\"type\": \"Polygon\", \"coordinates\": " + SQUARE + "}")));
    }
}
