package io.furrow.suite;

import java.nio.file.Path;
import java.time.Duration;
import java.util.LinkedHashMap;
import java.util.Map;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.http.AllowedNames;
import io.furrow.launcher.suite.SuiteSettings;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Devices with only their credentials and an MQTT client, beside simulated ones. */
class RealDevicesIT {
    private static final String PLACE = "{\"latitude\": 40.3134, \"longitude\": -3.4831}";

    private static final String PLACE_REPORT = "'{\"lat\": 40.3134, \"lon\": -3.4831}'";

    @AutoClose
    private static RunningSuite running;

    @BeforeAll
    static void startAFarmWithoutSimulatedDevices() throws Exception {
        SuiteSettings defaults = SuiteSettings.onFreePorts("2s");
        SuiteSettings.Farm farm = defaults.farm();
        running = RunningSuite.start(
                null,
                new SuiteSettings(
                        null,
                        defaults.fiware(),
                        defaults.window(),
                        null,
                        defaults.ports(),
                        null,
                        null,
                        null,
                        new SuiteSettings.Farm(
                                null,
                                null,
                                null,
                                null,
                                farm.accounts(),
                                farm.secret(),
                                null,
                                new SuiteSettings.Missions(Duration.ofSeconds(3), true, false)),
                        SuiteSettings.Watch.DEFAULT,
                        AllowedNames.NONE,
                        defaults.page(),
                        false));
        running.awaitReady();
        running.post("/api/domains", "{\"domain\":\"home\"}");
    }

    @Tag("full")
    @Test
    void reportsByTheExampleOfItsCredentials() throws Exception {
        start("first", """
                {"type": "Thermometer", "count": 2, "period": "PT15M", "at": [%1$s, %1$s], "attributes": [
                  {"object_id": "t", "name": "Temperature", "unit": "CEL"}]}""".formatted(PLACE));
        await().until(() ->
                running.mission("first").at("/status/reason").asText().startsWith("2 of 2 devices are not up"));
        await().until(() -> running.get("/api/alarms")
                .findValuesAsText("text")
                .contains("mission first: "
                        + running.mission("first").at("/status/reason").asText()));
        JsonNode logins = running.get("/api/missions/first/credentials");
        assertThat(logins).hasSize(2);

        String example = logins.at("/0/example").asText();
        Command.run("sh", "-c", example);

        running.awaitState("first", "running");
        await().until(() -> running.mission("first")
                .at("/status/missing/0/reason")
                .asText()
                .startsWith("it has not connected to the MQTT broker since "));
        JsonNode entity = running.ngsi().entity(logins.at("/0/device").asText());
        assertThat(entity.at("/Temperature/value").asInt()).isEqualTo(21);
        assertThat(entity.at("/Temperature/metadata/unitCode/value").asText()).isEqualTo("CEL");
        assertThat(entity.at("/Latitude/value").asDouble()).isEqualTo(40.3134);
        // A window ends when later measures arrive.
        await().pollInterval(Duration.ofSeconds(1)).untilAsserted(() -> {
            Command.run("sh", "-c", example);
            assertThat(running.ngsi()
                            .entity("Analytics:FieldTemperature:field-1")
                            .at("/averageTemperature/value")
                            .asInt())
                    .isEqualTo(21);
        });
        running.post("/api/missions/first/stop", "{}");
        running.awaitState("first", "stopped");
        running.send("DELETE", "/api/missions/first", "");
        await().until(() ->
                running.ngsi().entities("id=urn:ngsi-ld:Mission:first").isEmpty());
    }

    @Tag("full")
    @Test
    void runsTheProgramOfTheDocumentationWhichAnswersCommands() throws Exception {
        start("program", "{\"type\": \"Thermometer\", \"at\": %s}".formatted(PLACE));
        await().until(() -> running.get("/api/missions/program/credentials").size() == 1);
        JsonNode login = running.get("/api/missions/program/credentials").path(0);
        Map<String, String> variables = new LinkedHashMap<>();
        Map.of(
                        "MQTT_HOST", "host",
                        "MQTT_PORT", "port",
                        "MQTT_USER", "user",
                        "MQTT_PASSWORD", "password",
                        "MQTT_DEVICE_ID", "deviceId",
                        "MQTT_MEASURES", "measures",
                        "MQTT_COMMANDS", "commands",
                        "MQTT_RESULTS", "results")
                .forEach(
                        (name, member) -> variables.put(name, login.path(member).asText()));
        variables.put("PERIOD", "0.5");
        String device = login.path("device").asText();
        String program = Path.of("..", "docs", "examples", "thermometer.py").toString();
        try (Command thermometer = Command.start(variables, "python3", program)) {
            running.awaitState("program", "running");
            running.post("/api/devices/" + device + "/commands", "{\"command\":\"off\"}");
            await().until(() -> thermometer.printed().contains("asked: {'off'"));
            await().until(() -> running.ngsi()
                    .entity(device)
                    .at("/off_status/value")
                    .asText()
                    .equals("OK"));
        }
        running.post("/api/missions/program/stop", "{}");
    }

    @Tag("full")
    @Test
    void simulatesOnlyTheSimulatedDevicesOfAMission() throws Exception {
        start("mixed", """
                {"type": "Thermometer", "count": 40, "simulated": true, "period": "PT1S", "area": "field-1"},
                {"name": "real", "type": "WeatherStation", "count": 39, "at": %s},
                {"type": "Robot"}""".formatted(PLACE));
        await().until(() -> running.mission("mixed").at("/status/confirmed").asInt() == 40);
        JsonNode logins = running.get("/api/missions/mixed/credentials");
        assertThat(logins).hasSize(40);
        for (JsonNode login : logins) {
            String device = login.path("device").asText();
            assertThat(device).containsAnyOf("WeatherStation", "Robot");
            String example = login.path("example").asText();
            Command.run(
                    "sh", "-c", device.contains("Robot") ? example.replaceFirst("'\\{.*}'", PLACE_REPORT) : example);
        }
        await().untilAsserted(() ->
                assertThat(running.mission("mixed").path("status").toString()).contains("\"confirmed\":80"));
        JsonNode stations = running.ngsi().entities("type=WeatherStation&idPattern=.*mixed.*");
        assertThat(stations)
                .hasSize(39)
                .allMatch(each -> each.at("/Temperature/value").asInt() == 21
                        && each.path("Humidity").isMissingNode());
        await().until(() -> texts().anyMatch(text -> text.matches(".*Robot.* and .*Station.* came within .*")));
        assertThat(texts()).noneMatch(text -> text.matches(".*Station.* and .*Station.* came within .*"));
        running.post("/api/missions/mixed/stop", "{}");
    }

    private static Stream<String> texts() throws Exception {
        return running.get("/api/alarms").findValuesAsText("text").stream();
    }

    private static void start(String mission, String devices) throws Exception {
        String body = "{\"domain\":\"home\",\"devices\":[%s]}".formatted(devices);
        assertThat(running.post("/api/missions/" + mission + "/start", body)
                        .path("status")
                        .asText())
                .isEqualTo("started");
    }
}
