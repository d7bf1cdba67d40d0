package io.furrow.simulators.fleet;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Optional;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.Entity;
import io.furrow.model.position.Position;
import io.furrow.model.position.PositionReading;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Robot;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class FarmSimulationTest {
    private static final Instant START = Instant.parse("2026-06-01T08:00:00Z");
    private static final String FARM = """
            {"seed": 1, "apiKey": "k", "missions": [{"domain": "farm", "mission": "weeding", "devices": [
              {"type": "Thermometer", "id": "t", "at": {"latitude": 40.31, "longitude": -3.48}, "where": "yard", "period": "PT1S",
               "faults": [{"kind": "silent", "after": "PT1M"}]},
              {"type": "Robot", "id": "r", "period": "PT1S", "speed": 2, "tellsMission": false,
               "route": [{"latitude": 40.31, "longitude": -3.48}, {"latitude": 40.32, "longitude": -3.48}]},
              {"type": "Thermometer", "id": "on-robot", "carriedBy": "r", "period": "PT1S"},
              {"type": "Camera", "id": "c", "carriedBy": "r", "period": "PT1S"}]}]}
            """;

    private Farm farm;
    private FarmSimulation simulation;

    @BeforeEach
    void read() throws IOException {
        farm = Farm.read(new ByteArrayInputStream(FARM.getBytes(UTF_8)), START);
        simulation = simulation();
    }

    @Test
    void reportsWhatAThermometerMeasures() {
        ObjectNode json = measures("t", START.plusSeconds(5));

        assertThat(json.fieldNames()).toIterable().containsExactly("temp", "stat", "time", "lat", "lon", "where");
        assertThat(json.path("temp").doubleValue()).isBetween(5d, 30d);
        assertThat(json.path("stat").booleanValue()).isTrue();
        assertThat(json.path("time").longValue()).isEqualTo(START.plusSeconds(5).toEpochMilli());
        assertThat(json.path("lat").doubleValue()).isEqualTo(40.31);
        assertThat(json.path("where").textValue()).isEqualTo("yard");
    }

    @Test
    void reportsNothingOfASilentDevice() {
        assertThat(simulation.report(device("t"), START.plusSeconds(59))).isPresent();
        assertThat(simulation.report(device("t"), START.plusSeconds(60))).isEmpty();
    }

    @Test
    void movesARobotAndWhatItCarriesAlike() {
        Entity robot = update(START.plusSeconds(30));
        ObjectNode carried = measures("on-robot", START.plusSeconds(30));
        ObjectNode later = measures("c", START.plusSeconds(40));

        Position place = PositionReading.of(robot).usable().orElseThrow();
        assertThat((place.latitude() - 40.31) * 111_194.9).isEqualTo(60, within(0.01));
        assertThat(carried.path("lat").doubleValue()).isEqualTo(place.latitude(), within(1e-8));
        assertThat((later.path("lat").doubleValue() - 40.31) * 111_194.9).isEqualTo(80, within(0.01));
        assertThat(robot.value("Mission")).isEmpty();
        assertThat(later.path("img").textValue()).startsWith("iVBOR");
    }

    @Test
    void stopsARobotOnCommand() {
        update(START.plusSeconds(10));
        simulation.command((Robot) device("r"), true, START.plusSeconds(15));

        assertThat(meters(update(START.plusSeconds(60)))).isEqualTo(30, within(0.01));
        assertThat(update(START.plusSeconds(61)).text("state").orElseThrow()).contains("Stopped");

        simulation.command((Robot) device("r"), false, START.plusSeconds(100));
        assertThat(meters(update(START.plusSeconds(105)))).isEqualTo(40, within(0.01));
    }

    @Test
    void isSilentWhileItIsOffAndReportsSoOnce() {
        Optional<Report> last = simulation.switchTo(device("t"), false, START.plusSeconds(1));

        assertThat(((Report.Measures) last.orElseThrow()).json())
                .hasToString("{\"stat\":false,\"time\":1780300801000}");
        assertThat(simulation.switchTo(device("t"), false, START.plusSeconds(2)))
                .isEmpty();
        assertThat(simulation.report(device("t"), START.plusSeconds(3))).isEmpty();
        assertThat(simulation.switchTo(device("t"), true, START.plusSeconds(4))).isEmpty();
        assertThat(simulation.report(device("t"), START.plusSeconds(5))).isPresent();
    }

    @Test
    void isSilentWhileItRestartsAndSwitchedOnAfterThat() {
        simulation.switchTo(device("t"), false, START.plusSeconds(1));
        simulation.restart("t", START.plusSeconds(5));

        assertThat(simulation.report(device("t"), START.plusMillis(4999))).isEmpty();
        assertThat(simulation.report(device("t"), START.plusSeconds(5))).isPresent();
    }

    @Test
    void goesOnAlongItsWayAsIfItHadBeenThereAllTheTime() {
        FarmSimulation later = new FarmSimulation();
        later.add(device("r"), START, START.plusSeconds(20));

        Report report = later.report(device("r"), START.plusSeconds(30)).orElseThrow();

        assertThat(meters(((Report.Update) report).entity())).isEqualTo(60, within(0.01));
    }

    @Test
    void reportsNothingOfWhatIsCarriedByARobotThatIsGone() {
        simulation.remove("r");

        assertThat(simulation.report(device("on-robot"), START.plusSeconds(1))).isEmpty();
        assertThat(simulation.report(device("c"), START.plusSeconds(1))).isEmpty();
    }

    @Test
    void showsTheSameAtTheSameTimes() {
        assertThat(hour(simulation())).isEqualTo(hour(simulation())).hasSizeGreaterThan(300);
    }

    private List<Report> hour(FarmSimulation simulation) {
        List<Report> reports = new ArrayList<>();
        for (int second = 0; second < 3600; second += 30) {
            for (SimulatedDevice device : farm.devices()) {
                simulation.report(device, START.plusSeconds(second)).ifPresent(reports::add);
            }
        }
        return reports;
    }

    private FarmSimulation simulation() {
        FarmSimulation made = new FarmSimulation();
        farm.devices().forEach(device -> made.add(device, START, START));
        return made;
    }

    private static double meters(Entity robot) {
        return (PositionReading.of(robot).usable().orElseThrow().latitude() - 40.31) * 111_194.9;
    }

    private ObjectNode measures(String id, Instant now) {
        return ((Report.Measures) simulation.report(device(id), now).orElseThrow()).json();
    }

    private Entity update(Instant now) {
        return ((Report.Update) simulation.report(device("r"), now).orElseThrow()).entity();
    }

    private SimulatedDevice device(String id) {
        return farm.devices().stream()
                .filter(device -> device.id().equals(id))
                .findFirst()
                .orElseThrow();
    }
}
