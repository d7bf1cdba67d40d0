package io.furrow.simulators.scenario;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.OptionalDouble;
import java.util.regex.Pattern;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.simulators.scenario.SimulatedDevice.Camera;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;
import io.furrow.simulators.scenario.SimulatedDevice.Sensor;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

class FarmTest {
    static final Instant START = Instant.parse("2026-06-01T08:00:00Z");
    static final String FIELDS = """
            {"type": "FeatureCollection", "features": [{"type": "Feature", "id": "field-1", "properties": {}, "geometry":
              {"type": "Polygon", "coordinates": [[[-3.4841, 40.3130], [-3.4819, 40.3130], [-3.4819, 40.3144], [-3.4841, 40.3130]]]}}]}
            """;
    private static final String FARM = """
            {"seed": 7, "apiKey": "secret", "fields": %s, "missions": [
              {"domain": "farm", "mission": "weeding", "devices": [
                {"type": "Thermometer", "id": "t", "count": 5, "area": "field-1", "period": "PT1S", "meanCelsius": 20,
                 "faults": [{"kind": "stuck", "value": 60, "numbers": [4]}, {"kind": "silent", "after": "PT10M", "numbers": [5]}]},
                {"type": "WeatherStation", "id": "w", "at": {"latitude": 40.31, "longitude": -3.48}, "where": "yard", "period": "PT1M",
                 "faults": [{"kind": "drift", "attribute": "Pressure", "perHour": 2}]},
                {"type": "Robot", "id": "r", "count": 2, "period": "PT0.5S", "rows": {"field": "field-1", "spacing": 4}, "speed": 1.5, "meeting": 5},
                {"type": "Camera", "id": "c", "count": 2, "period": "PT5S", "carriedBy": "r"},
                {"type": "Camera", "id": "eye", "period": "PT5S", "carriedBy": "r-2", "heading": 90}]},
              {"domain": "farm", "mission": "scouting", "devices": [
                {"type": "Camera", "id": "moving", "entity": "urn:x:1", "period": "PT5S", "speed": 2,
                 "route": [{"latitude": 40.3, "longitude": -3.48}, {"latitude": 40.4, "longitude": -3.48}]}]}]}
            """.formatted(FIELDS);

    @Test
    void hasTheDevicesOfEachGroup() throws IOException {
        Farm farm = read(FARM);

        assertThat(farm.apiKey()).isEqualTo("secret");
        assertThat(farm.devices())
                .extracting(SimulatedDevice::id)
                .containsExactly("t-1", "t-2", "t-3", "t-4", "t-5", "w", "r-1", "r-2", "c-1", "c-2", "eye", "moving");
        assertThat(device(farm, "t-2", Sensor.class).identity())
                .isEqualTo(new SimulatedDevice.Identity(
                        "t-2", "urn:ngsi-ld:Thermometer:t-2", "Thermometer", "farm", "weeding"));
        assertThat(device(farm, "moving", Camera.class).identity().entity()).isEqualTo("urn:x:1");
        assertThat(device(farm, "r-1", Robot.class).period()).isEqualTo(Duration.ofMillis(500));
        assertThat(device(farm, "r-1", Robot.class).model().encounterDistance()).isEqualTo(5);
    }

    @Test
    void carriesTheNthOfAGroupByTheNthOfTheOther() throws IOException {
        Farm farm = read(FARM);

        assertThat(device(farm, "c-1", Camera.class).place().carrier()).isEqualTo("r-1");
        assertThat(device(farm, "c-2", Camera.class).place().carrier()).isEqualTo("r-2");
        assertThat(device(farm, "eye", Camera.class).place().carrier()).isEqualTo("r-2");
    }

    @Test
    void putsDevicesOfAnAreaIntoItEachElsewhere() throws IOException {
        List<Sensor> thermometers = sensors(read(FARM));

        assertThat(thermometers)
                .extracting(each -> each.place().way().at(0).place())
                .doesNotHaveDuplicates()
                .allSatisfy(place -> {
                    assertThat(place.longitude()).isBetween(-3.4841, -3.4819);
                    assertThat(place.latitude())
                            .isGreaterThan(40.3130)
                            .isLessThan(40.3130 + 0.0014 * (place.longitude() + 3.4841) / 0.0022 + 1e-9);
                });
        assertThat(thermometers.get(0).place().where()).isEqualTo("field-1");
    }

    @Test
    void givesItsFaultsToTheDevicesWithTheirNumbers() throws IOException {
        Farm farm = read(FARM);

        Instant later = START.plusSeconds(700);
        assertThat(shown(device(farm, "t-3", Sensor.class), "Temperature", later)
                        .getAsDouble())
                .isLessThan(40);
        assertThat(shown(device(farm, "t-4", Sensor.class), "Temperature", later))
                .hasValue(60);
        assertThat(shown(device(farm, "t-5", Sensor.class), "Temperature", START.plusSeconds(599)))
                .isPresent();
        assertThat(shown(device(farm, "t-5", Sensor.class), "Temperature", later))
                .isEmpty();
    }

    @Test
    void distortsTheAttributeThatAFaultNames() throws IOException {
        Sensor faulty = device(read(FARM), "w", Sensor.class);
        Sensor sound = device(read(FARM.replace("\"perHour\": 2", "\"perHour\": 0")), "w", Sensor.class);
        Instant later = START.plus(Duration.ofHours(10));

        assertThat(shown(faulty, "Pressure", later).getAsDouble())
                .isEqualTo(shown(sound, "Pressure", later).getAsDouble() + 20, within(1e-9));
        assertThat(shown(faulty, "Temperature", later)).isEqualTo(shown(sound, "Temperature", later));
        assertThat(faulty.quantities())
                .extracting(quantity -> quantity.attribute().name())
                .containsExactly(
                        "Temperature", "Humidity", "Pressure", "WindSpeed", "WindDirection", "Rain", "SolarRadiation");
    }

    @Test
    void isTheSameFarmForTheSameSeedAndAnotherForAnother() throws IOException {
        List<Sensor> one = sensors(read(FARM));
        List<Sensor> same = sensors(read(FARM));
        List<Sensor> other = sensors(read(FARM.replace("\"seed\": 7", "\"seed\": 8")));

        for (int i = 0; i < one.size(); i++) {
            assertThat(same.get(i).place().way().at(0))
                    .isEqualTo(one.get(i).place().way().at(0));
            assertThat(other.get(i).place().way().at(0))
                    .isNotEqualTo(one.get(i).place().way().at(0));
            assertThat(shown(same.get(i), "Temperature", START)).isEqualTo(shown(one.get(i), "Temperature", START));
        }
        assertThat(shown(other.get(0), "Temperature", START)).isNotEqualTo(shown(one.get(0), "Temperature", START));
        assertThat(one.stream().limit(3).map(each -> shown(each, "Temperature", START)))
                .doesNotHaveDuplicates();
    }

    /** What is replaced in the farm above, by what, and what is said then. */
    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
        "seed": 7                   | "seed": -1                  | seed: must be a whole number from 0 to 9223372036854775807, not -1
        "seed": 7                   | "sed": 7                    | sed: is not known here; known are apiKey, fields, missions, seed
        "apiKey": "secret"          | "apiKey": "a/b"             | apiKey: must be 1 to 64 of A-Z a-z 0-9 _ -, not 'a/b'
        "apiKey": "secret",         | ,                           | line 1: is not valid JSON: Unexpected character (',' (code 44)): was expecting double-quote to start field name
        "apiKey": "secret",         | ''                          | apiKey: must be a text, and is missing
        "mission": "weeding"        | "mission": "a.b"            | missions[0].mission: must be 1 to 64 of A-Z a-z 0-9 _ -, not 'a.b'
        "type": "WeatherStation"    | "type": "Barn"              | missions[0].devices[1].type: 'Barn' is not a type of device; use Thermometer, WeatherStation, Camera or Robot
        "period": "PT1M"            | "period": "1m"              | missions[0].devices[1].period: must be a duration, for instance PT1S or PT10M, not "1m"
        "period": "PT1M"            | "period": "PT0S"            | missions[0].devices[1].period: must be longer than PT0S
        "count": 5                  | "count": 0                  | missions[0].devices[0].count: must be a whole number from 1 to 100000, not 0
        "meanCelsius": 20           | "meanCelsius": 200          | missions[0].devices[0].meanCelsius: must be a number from -60 to 60, not 200
        "meanCelsius": 20           | "meanCelcius": 20           | missions[0].devices[0].meanCelcius: is not known here; known are area, at, battery, carriedBy, count, entity, faults, id, meanCelsius, period, route, type, where
        "meanCelsius": 20           | "where": "yard (north)"     | missions[0].devices[0].where: must not contain any of < > " ' = ; ( ), which the context broker refuses in a text, not "yard (north)"
        "area": "field-1"           | "area": "field-2"           | missions[0].devices[0].area: there is no field 'field-2'; there are: field-1
        "area": "field-1",          | ''                          | missions[0].devices[0].area: is missing; say where it is with one of area, at, route or carriedBy
        "area": "field-1"           | "area": "field-1", "carriedBy": "r" | missions[0].devices[0].carriedBy: says again where the device is, after area; leave one out
        "rows": {                   | "route": [], "rows": {      | missions[0].devices[2].route: says again where the device is, after rows; leave one out
        "kind": "stuck"             | "kind": "loose"             | missions[0].devices[0].faults[0].kind: 'loose' is not a kind of fault; use stuck, drift, spikes or silent
        "numbers": [4]              | "numbers": 4                | missions[0].devices[0].faults[0].numbers: must be a list of the devices' numbers, from 1, as in [1, 3]
        "attribute": "Pressure"     | "attribute": "pressure"     | missions[0].devices[1].faults[0].attribute: 'pressure' is not shown; shown are Temperature, Humidity, Pressure, WindSpeed, WindDirection, Rain, SolarRadiation
        "carriedBy": "r-2"          | "carriedBy": "r-3"          | missions[0].devices[4].carriedBy: there is no robot 'r-3' in mission 'weeding'; a carrier is a robot of the same mission
        "id": "eye"                 | "id": "w"                   | missions[0].devices[4].id: 'w' is taken by missions[0].devices[1]; give it another
        "entity": "urn:x:1"         | "entity": "urn:ngsi-ld:Robot:r-1" | missions[1].devices[0].entity: 'urn:ngsi-ld:Robot:r-1' is taken by missions[0].devices[2]; give it another
        "spacing": 4                | "spacing": 4, "margin": 100 | missions[0].devices[2].rows: field 'field-1' has no room for a row 100.0 m from its edge: give a smaller margin
        "rows": {"field": "field-1", "spacing": 4}, | ''          | missions[0].devices[2].rows: is missing; a robot needs either rows or a route
        "meeting": 5                | "obstacles": {"every": "PT1M"} | missions[0].devices[2].obstacles: is not known here; known are count, entity, id, meeting, patience, period, route, rows, speed, start, tellsMission, turnRate, type, width
        "meanCelsius": 20           | "battery": "PT0S"           | missions[0].devices[0].battery: must be at least PT0.001S
        {"latitude": 40.3,          | {"latitude": 140.3,         | missions[1].devices[0].route[0].latitude: must be a number from -90 to 90, not 140.3
        "type": "Polygon"           | "type": "Point"             | fields.features[0]: the geometry of field 'field-1' is not a Polygon: make each part of a MultiPolygon a field of its own
        """)
    void saysWhereWhatIsWrongAndWhatToDo(String right, String wrong, String sentence) {
        String broken = FARM.replaceFirst(Pattern.quote(right), wrong == null ? "" : wrong);
        assertThat(broken).isNotEqualTo(FARM);

        assertThatThrownBy(() -> read(broken))
                .isInstanceOf(InvalidScenarioException.class)
                .hasMessage(sentence);
    }

    static Farm read(String json) throws IOException {
        return Farm.read(new ByteArrayInputStream(json.getBytes(UTF_8)), START);
    }

    static <T> T device(Farm farm, String id, Class<T> type) {
        return farm.devices().stream()
                .filter(device -> device.id().equals(id))
                .map(type::cast)
                .findFirst()
                .orElseThrow();
    }

    private static List<Sensor> sensors(Farm farm) {
        return farm.devices().stream()
                .filter(device -> device.identity().type().equals("Thermometer"))
                .map(Sensor.class::cast)
                .toList();
    }

    private static OptionalDouble shown(Sensor sensor, String attribute, Instant time) {
        return sensor.quantities().stream()
                .filter(quantity -> quantity.attribute().name().equals(attribute))
                .findFirst()
                .orElseThrow()
                .signal()
                .at(time);
    }
}
