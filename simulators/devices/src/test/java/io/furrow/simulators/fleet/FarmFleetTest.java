package io.furrow.simulators.fleet;

import java.io.ByteArrayInputStream;
import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Clock;
import java.time.Instant;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.position.PositionReading;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.MqttTestClient;
import io.furrow.simulators.scenario.Farm;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class FarmFleetTest {
    private static final String FARM = """
            {"seed": 1, "apiKey": "k", "missions": [
              {"domain": "farm", "mission": "weeding", "devices": [
                {"type": "Thermometer", "id": "t", "count": 3, "at": {"latitude": 40.31, "longitude": -3.48}, "period": "PT0.05S"},
                {"type": "Robot", "id": "r", "period": "PT0.05S", "speed": 2,
                 "route": [{"latitude": 40.31, "longitude": -3.48}, {"latitude": 40.32, "longitude": -3.48}]},
                {"type": "Camera", "id": "c", "carriedBy": "r", "period": "PT0.1S"}]},
              {"domain": "farm", "mission": "scouting", "devices": [
                {"type": "WeatherStation", "id": "w", "at": {"latitude": 40.3, "longitude": -3.4}, "period": "PT0.05S"}]}]}
            """;

    @AutoClose
    private static EmbeddedMqtt mqtt;

    @AutoClose
    private static FiwareStandIn fiware;

    private FarmFleet fleet;
    private MqttTestClient listener;

    @BeforeAll
    static void startEnds() throws Exception {
        mqtt = EmbeddedMqtt.start(Map.of("farmer", "plough"));
        fiware = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), "farmer", "plough"));
    }

    @AfterEach
    void closeAll() {
        if (fleet != null) {
            fleet.close();
        }
        if (listener != null) {
            listener.close();
        }
    }

    @Test
    void bringsEveryDeviceIntoTheContextBroker() throws Exception {
        fleet = FarmFleet.start(farm(), access("plough"));

        await().untilAsserted(() -> {
            for (String id : List.of("Thermometer:t-1", "Thermometer:t-3", "Camera:c", "WeatherStation:w", "Robot:r")) {
                Entity entity = entity(id);
                assertThat(entity.text("Domain")).contains("farm");
                assertThat(entity.text("Mission")).isPresent();
                assertThat(PositionReading.of(entity).usable()).isPresent();
                assertThat(entity.number("Time")).isPresent();
            }
            assertThat(entity("WeatherStation:w").number("SolarRadiation")).isPresent();
            assertThat(entity("Camera:c").text("Image")).isPresent();
        });
        assertThat(fleet.connections()).isEqualTo(5);
        assertThat(fleet.reports()).isPositive();
        await().until(() -> fleet.tally().acknowledged() > 10);
    }

    @Test
    void putsManyDevicesOfAMissionOnOneConnectionWithTheirOwnTopics() throws Exception {
        listener = new MqttTestClient(settings("plough"));
        fleet = FarmFleet.start(farm(), access("plough"), 4, Clock.systemUTC());

        await().untilAsserted(() -> {
            for (String device : List.of("t-1", "t-2", "t-3", "c", "w")) {
                assertThat(listener.received("/k/" + device + "/attrs")).isNotEmpty();
            }
        });
        assertThat(fleet.connections()).isEqualTo(2);
        listener.publish("/k/t-2/cmd", "{\"off\":\"\"}");
        await().untilAsserted(() ->
                assertThat(listener.received("/k/t-2/cmdexe")).singleElement().hasToString("{\"off\":\"ok\"}"));
        assertThat(listener.received("/k/t-1/cmdexe")).isEmpty();
    }

    @Test
    void switchesADeviceOffAndOn() throws Exception {
        listener = new MqttTestClient(settings("plough"));
        fleet = FarmFleet.start(farm(), access("plough"), 500, Clock.systemUTC());
        await().until(() -> !listener.received("/k/t-1/attrs").isEmpty());

        listener.publish("/k/t-1/cmd", "{\"off\":\"\"}");
        await().until(() -> !lastStatus());
        int received = listener.received("/k/t-1/attrs").size();
        long reports = fleet.reports();
        await().until(() -> fleet.reports() > reports + 30);
        assertThat(listener.received("/k/t-1/attrs")).hasSize(received);

        listener.publish("/k/t-1/cmd", "{\"on\":\"\"}");
        await().until(this::lastStatus);
    }

    @Test
    void answersACommandThatNobodyImplements() throws Exception {
        listener = new MqttTestClient(settings("plough"));
        fleet = FarmFleet.start(farm(), access("plough"), 500, Clock.systemUTC());

        listener.publish("/k/t-1/cmd", "off!");
        listener.publish("/k/t-1/cmd", "{\"dance\":\"\"}");

        await().until(() -> !listener.received("/k/t-1/cmdexe").isEmpty());
        assertThat(listener.received("/k/t-1/cmdexe")).singleElement().hasToString("{\"dance\":\"unknown command\"}");
    }

    @Test
    void stopsARobotByItsAttributeAndReportsWhatBecameOfIt() throws Exception {
        fleet = FarmFleet.start(farm(), access("plough"));
        await().untilAsserted(() -> assertThat(entity("Robot:r").value("cmd")).contains(TextNode.valueOf("")));

        command("Stop");
        await().untilAsserted(() -> {
            assertThat(entity("Robot:r").text("state").orElse("")).contains("Stopped");
            assertThat(entity("Robot:r").text("cmd_status")).contains("OK");
            assertThat(entity("Robot:r").text("cmd_info")).contains("Stop");
        });
        Object stopped = PositionReading.of(entity("Robot:r"));
        long reports = fleet.reports();
        await().until(() -> fleet.reports() > reports + 30);
        assertThat(PositionReading.of(entity("Robot:r"))).isEqualTo(stopped);

        command("Dance");
        await().untilAsserted(() -> {
            assertThat(entity("Robot:r").text("cmd_status")).contains("ERROR");
            assertThat(entity("Robot:r").text("cmd_info"))
                    .contains("no such command: use Running, Stop, Resume, on, off or restart");
        });
        command("Resume");
        await().untilAsserted(() ->
                assertThat(entity("Robot:r").text("state").orElse("")).contains("Running"));
    }

    @Test
    void switchesARobotOffAndOnAndRestartsIt() throws Exception {
        fleet = FarmFleet.start(farm(), access("plough"));
        await().untilAsserted(() -> assertThat(entity("Robot:r").value("cmd")).contains(TextNode.valueOf("")));

        command("off");
        await().untilAsserted(
                        () -> assertThat(entity("Robot:r").text("cmd_info")).contains("off"));
        Object silentSince = entity("Robot:r").number("Time");
        long reports = fleet.reports();
        await().until(() -> fleet.reports() > reports + 30);
        assertThat(entity("Robot:r").number("Time")).isEqualTo(silentSince);

        command("restart");
        await().untilAsserted(() -> {
            Entity robot = entity("Robot:r");
            assertThat(robot.text("cmd_info")).contains("restart");
            assertThat(robot.value("cmd")).contains(TextNode.valueOf(""));
            assertThat(robot.number("Time")).isNotEqualTo(silentSince);
        });
    }

    @Test
    void runsNoCommandOfBeforeItsStart() throws Exception {
        fleet = FarmFleet.start(farm(), access("plough"));
        await().untilAsserted(() -> assertThat(entity("Robot:r").value("cmd")).contains(TextNode.valueOf("")));
        fleet.close();
        command("Stop");

        fleet = FarmFleet.start(farm(), access("plough"));

        await().untilAsserted(() -> assertThat(entity("Robot:r").value("cmd")).contains(TextNode.valueOf("")));
        long reports = fleet.reports();
        await().until(() -> fleet.reports() > reports + 150);
        assertThat(entity("Robot:r").text("state").orElse("")).contains("Running");
    }

    @Test
    void isRefusedWithAWrongPasswordAndLeavesNothingBehind() {
        assertThatThrownBy(() -> FarmFleet.start(farm(), access("harrow"), 500, Clock.systemUTC()))
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("refuses user 'farmer'", mqtt.uri().toString())
                .hasMessageNotContaining("harrow");
        assertThat(access("harrow").toString()).doesNotContain("harrow");
    }

    private boolean lastStatus() {
        List<JsonNode> received = listener.received("/k/t-1/attrs");
        return received.get(received.size() - 1).path("stat").booleanValue();
    }

    private static Farm farm() throws IOException {
        return Farm.read(new ByteArrayInputStream(FARM.getBytes(UTF_8)), Instant.now());
    }

    private static FleetAccess access(String password) {
        return Subscriber.access(settings(password));
    }

    private static FleetSettings settings(String password) {
        return new FleetSettings(
                fiware.contextBroker(), fiware.iotAgent(), mqtt.uri(), "farmer", password, "farm", "/");
    }

    private static Entity entity(String id) throws Exception {
        HttpResponse<byte[]> answer =
                send(request("/v2/entities/urn:ngsi-ld:" + id).build());
        assertThat(answer.statusCode()).as(id).isEqualTo(200);
        return Entity.of(NgsiJson.read(answer.body()));
    }

    private static void command(String word) throws Exception {
        HttpResponse<byte[]> answer = send(request("/v2/entities/urn:ngsi-ld:Robot:r/attrs")
                .header("Content-Type", "application/json")
                .method(
                        "PATCH",
                        HttpRequest.BodyPublishers.ofString(
                                "{\"cmd\": {\"type\": \"String\", \"value\": \"%s\"}}".formatted(word)))
                .build());
        assertThat(answer.statusCode()).isEqualTo(204);
    }

    private static HttpRequest.Builder request(String path) {
        return HttpRequest.newBuilder(URI.create(fiware.contextBroker() + path))
                .header("fiware-service", "farm")
                .header("fiware-servicepath", "/");
    }

    private static HttpResponse<byte[]> send(HttpRequest request) throws Exception {
        return HttpClient.newHttpClient().send(request, HttpResponse.BodyHandlers.ofByteArray());
    }
}
