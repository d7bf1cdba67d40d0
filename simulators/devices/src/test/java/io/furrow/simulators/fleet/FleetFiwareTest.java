package io.furrow.simulators.fleet;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.file.AccessToken;
import io.furrow.simulators.device.FiwareServers;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.scenario.Farm;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** What a fleet says to the IoT Agent and the context broker, and what it leaves behind. */
class FleetFiwareTest {
    private static final String THERMOMETER = """
            {"type": "Thermometer", "id": "t1", "entity": "urn:ngsi-ld:Thermometer:1", "period": "PT0.05S",
             "at": {"latitude": 40.31, "longitude": -3.48}}
            """;
    private static final String ROBOT = """
            {"type": "Robot", "id": "r1", "period": "PT0.05S", "route": [{"latitude": 40.31, "longitude": -3.48}]}
            """;

    @AutoClose
    private static FiwareServers ends;

    @BeforeAll
    static void start() throws IOException {
        ends = new FiwareServers();
    }

    @BeforeEach
    void reset() {
        ends.reset();
    }

    @Test
    void reportsWhichIotAgentDoesNotAnswer() {
        FleetSettings right = ends.settings();
        FleetSettings wrong = new FleetSettings(
                right.contextBroker(), URI.create("http://127.0.0.1:1"), right.mqtt(), "farmer", "plough", "farm", "/");

        assertThatThrownBy(() -> FarmFleet.start(farm(THERMOMETER), Subscriber.access(wrong)))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("http://127.0.0.1:1/iot/services");
    }

    @Test
    void reportsWhyTheIotAgentRejects() {
        ends.answer(request -> request.path().equals("/iot/devices") ? 400 : 201);

        assertThatThrownBy(() -> FarmFleet.start(farm(THERMOMETER), Subscriber.access(ends.settings())))
                .isInstanceOf(IOException.class)
                .hasMessageContaining("answers 400 to POST /iot/devices");
    }

    @Test
    void provisionsItsDevicesAsTheContractSays() throws Exception {
        FarmFleet.start(farm(THERMOMETER), Subscriber.access(ends.settings())).close();

        FiwareServers.ReceivedRequest group = ends.requested("/iot/services").get(0);
        assertThat(group.service()).isEqualTo("farm");
        assertThat(group.servicePath()).isEqualTo("/fields");
        assertThat(group.body().at("/services/0/apikey").textValue()).isEqualTo("key");
        assertThat(group.body().at("/services/0/resource").textValue()).isEqualTo("/iot/json");

        JsonNode device = ends.requested("/iot/devices").get(0).body().at("/devices/0");
        assertThat(device.path("device_id").textValue()).isEqualTo("t1");
        assertThat(device.path("entity_name").textValue()).isEqualTo("urn:ngsi-ld:Thermometer:1");
        assertThat(device.path("entity_type").textValue()).isEqualTo("Thermometer");
        assertThat(device.path("transport").textValue()).isEqualTo("MQTT");
        assertThat(device.path("attributes").findValuesAsText("object_id"))
                .containsExactly("temp", "stat", "time", "lat", "lon", "where");
        assertThat(device.path("attributes").findValuesAsText("name"))
                .containsExactly("Temperature", "Status", "Time", "Latitude", "Longitude", "Location");
        assertThat(device.path("static_attributes").findValuesAsText("value")).containsExactly("farm", "weeding");
        assertThat(device.path("commands").findValuesAsText("name")).containsExactly("on", "off", "restart");
    }

    @Test
    void sendsATokenToTheProxyThatGuardsAgentAndBroker(@TempDir Path directory) throws Exception {
        Path file = Files.writeString(directory.resolve("token"), "letmein\n");
        FleetSettings settings = ends.settings().withToken(AccessToken.of(file, null, warning -> {}));

        FarmFleet.start(farm(THERMOMETER), Subscriber.access(settings)).close();
        try (FarmFleet fleet = FarmFleet.start(farm(ROBOT), Subscriber.access(settings), 500, Clock.systemUTC())) {
            await().until(() ->
                    fleet.reports() > 0 && !ends.requested("/v2/op/update").isEmpty());
        }

        for (String path : List.of("/iot/services", "/iot/devices", "/v2/op/update")) {
            assertThat(ends.requested(path))
                    .as(path)
                    .isNotEmpty()
                    .allSatisfy(request -> assertThat(request.token()).isEqualTo("letmein"));
        }
    }

    @Test
    void makesItsGroupUnderTheResourceThatIsSet() throws Exception {
        FleetSettings settings = ends.settings().withIotAgentResource("");

        FarmFleet.start(farm(THERMOMETER), Subscriber.access(settings)).close();

        assertThat(ends.requested("/iot/services")
                        .get(0)
                        .body()
                        .at("/services/0/resource")
                        .textValue())
                .isEmpty();
    }

    @Test
    void startsAgainWhereTheAgentHasItsDevices() throws Exception {
        ends.answer(request -> 409);

        try (FarmFleet fleet = FarmFleet.start(farm(THERMOMETER), Subscriber.access(ends.settings()))) {
            await().until(() -> fleet.tally().acknowledged() > 0);
        }
    }

    @Test
    void goesOnReportingARobotWhoseBrokerRefusedForAWhile() throws Exception {
        ends.answer(request -> 500);
        try (FarmFleet fleet =
                FarmFleet.start(farm(ROBOT), Subscriber.access(ends.settings()), 500, Clock.systemUTC())) {
            await().until(() -> ends.requested("/v2/op/update").size() > 2);
            ends.reset();

            await().until(() -> ends.requested("/v2/op/update").size() > 2);
            JsonNode robot = ends.requested("/v2/op/update").get(2).body().at("/entities/0");
            assertThat(robot.path("id").textValue()).isEqualTo("urn:ngsi-ld:Robot:r1");
            assertThat(fleet.connections()).isZero();
        }
    }

    @Test
    void leavesNoThreadBehind() throws Exception {
        FarmFleet fleet = FarmFleet.start(farm(THERMOMETER), Subscriber.access(ends.settings()));
        assertThat(ofFleet()).isNotEmpty();

        fleet.close();

        await().untilAsserted(() -> assertThat(ofFleet()).isEmpty());
    }

    private static List<String> ofFleet() {
        return Thread.getAllStackTraces().keySet().stream()
                .map(Thread::getName)
                .filter(name -> name.contains("t1-") || name.startsWith("simulated-farm"))
                .toList();
    }

    private static Farm farm(String device) throws IOException {
        String json = """
                {"seed": 1, "apiKey": "key", "missions": [{"domain": "farm", "mission": "weeding", "devices": [%s]}]}
                """.formatted(device);
        return Farm.read(new ByteArrayInputStream(json.getBytes(UTF_8)), Instant.now());
    }
}
