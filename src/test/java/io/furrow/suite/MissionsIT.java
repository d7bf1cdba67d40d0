package io.furrow.suite;

import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import org.apache.kafka.clients.admin.NewTopic;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestReporter;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.bench.mission.MissionStart;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecretCodec;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Missions on a whole suite: REST API, managers, IoT Agent, MQTT broker, simulated devices, and back to Kafka. */
@Tag("full")
class MissionsIT {
    private static final int DEVICES = 100;
    private static final Duration TIMEOUT = Duration.ofSeconds(60);
    private static final HttpClient HTTP = HttpClient.newHttpClient();

    @Test
    void startsAMissionOfAHundredDevicesContinuesAfterARestartAndStopsIt(TestReporter reporter, @TempDir Path stored)
            throws Exception {
        try (RunningSuite running = RunningSuite.start(stored)) {
            Suite suite = running.suite();
            suite.kafka()
                    .admin()
                    .createTopics(List.of(new NewTopic(Topics.realtime("north"), Optional.empty(), Optional.empty())))
                    .all()
                    .get();
            try (var start = new MissionStart(suite.control(), suite.kafka().clientProperties(), "north")) {
                MissionStart.Delays delays =
                        start.run(new MissionStart.Plan("hoeing", DEVICES, Duration.ofSeconds(1)), TIMEOUT);
                reporter.publishEntry("mission of 100 devices", delays.toString());
            }
            assertThat(provisioned(suite)).isEqualTo(DEVICES);
        }
        try (RunningSuite running = RunningSuite.start(stored)) {
            Suite suite = running.suite();
            running.awaitState("hoeing", "running");
            JsonNode thermometer = running.ngsi().entity("urn:ngsi-ld:Thermometer:hoeing-1");
            await().until(() -> running.ngsi()
                            .entity("urn:ngsi-ld:Thermometer:hoeing-1")
                            .at("/Time/value")
                            .asLong()
                    > thermometer.at("/Time/value").asLong());

            running.post("/api/missions/hoeing/stop", "{}");

            running.awaitState("hoeing", "stopped");
            await().until(() -> provisioned(suite) == 0);
        }
    }

    @Test
    void continuesToReportDuringARotationOfTheFarmsSecret(@TempDir Path stored) throws Exception {
        try (RunningSuite running =
                RunningSuite.start(stored, SuiteSettings.onFreePorts("2s").withoutSharedLogin())) {
            Suite suite = running.suite();
            assertThat(publish(suite, Suite.MQTT_USER, Suite.MQTT_PASSWORD, "/key/any/attrs", "{}"))
                    .contains("bad user name or password");
            running.awaitReady();
            running.post("/api/domains", "{\"domain\":\"north\"}");
            running.post("/api/missions/hoeing/start", """
                    {"domain": "north", "devices": [
                      {"type": "Thermometer", "count": 3, "period": "PT0.2S", "path": [[-3.48, 40.31]]}]}
                    """);
            running.awaitState("hoeing", "running");

            Instant rotationEnd = Instant.now().plusSeconds(5);
            Path file = stored.resolve("farm-secret");
            FarmSecret rotated = FarmSecret.read(file).rotated(Instant.now(), rotationEnd, false);
            Files.writeString(file, FarmSecretCodec.write(rotated));

            for (int number = 1; number <= 3; number++) {
                String entity = "id=urn:ngsi-ld:Thermometer:hoeing-" + number;
                await().until(() ->
                        running.ngsi().entities(entity).at("/0/Time/value").asLong()
                                > rotationEnd.plusSeconds(3).toEpochMilli());
            }
            assertThat(running.mission("hoeing").at("/status/state").asText()).isEqualTo("running");
            assertThat(running.get("/api/devices/urn:ngsi-ld:Thermometer:hoeing-1/credentials")
                            .path("user")
                            .asText())
                    .isEqualTo(rotated.device("hoeing", "urn:ngsi-ld:Thermometer:hoeing-1")
                            .user());
        }
    }

    /** Makes the mistakes of a user who sets up a device by hand. */
    @Test
    void reportsWhyADeviceIsSilent(@TempDir Path stored) throws Exception {
        try (RunningSuite running =
                RunningSuite.start(stored, SuiteSettings.onFreePorts("2s").withoutSharedLogin())) {
            Suite suite = running.suite();
            String device = "urn:ngsi-ld:Thermometer:own";
            running.awaitReady();
            running.post("/api/domains", "{\"domain\":\"north\"}");
            running.post("/api/missions/hoeing/start", """
                    {"domain": "north", "devices": [{"type": "Thermometer", "id": "%s", "simulated": false}]}
                    """.formatted(device));
            await().until(() -> running.get("/api/devices/" + device)
                    .at("/connection/registered")
                    .asBoolean());
            JsonNode login = running.get("/api/devices/" + device + "/credentials");
            String user = login.path("user").asText();
            String password = login.path("password").asText();
            String topic = "/" + login.path("apiKey").asText() + "/" + device + "/attrs";

            publish(suite, user, "guessed", topic, "{}");
            assertThat(publish(suite, user, password, "/key/other/attrs", "{}")).isEmpty();
            assertThat(publish(suite, user, password, topic, "21.5 degrees")).isEmpty();
            assertThat(publish(suite, user, password, topic, "{\"temp\": 21.5}"))
                    .isEmpty();

            await().untilAsserted(() -> {
                JsonNode connection = running.get("/api/devices/" + device).path("connection");
                assertThat(connection.at("/refusedLogin/reason").asText()).isEqualTo("wrong-password");
                assertThat(connection.at("/foreignTopic/topic").asText()).isEqualTo("/key/other/attrs");
                assertThat(connection.at("/unreadablePayload/payload").asText()).isEqualTo("21.5 degrees");
                assertThat(connection.path("loggedIn").asLong()).isPositive();
                assertThat(connection.path("registered").asBoolean()).isTrue();
                assertThat(connection.at("/lastReport/received").asLong()).isPositive();
            });
        }
    }

    /** The output of mosquitto_pub: empty if its message was acknowledged. */
    private static String publish(Suite suite, String user, String password, String topic, String message)
            throws Exception {
        URI broker = suite.devices().mqtt();
        String port = Integer.toString(broker.getPort());
        var arguments = List.of("mosquitto_pub", "-h", broker.getHost(), "-p", port, "-u", user, "-P", password);
        List<String> content = List.of("-q", "1", "-t", topic, "-m", message);
        try (Command publisher = Command.start(
                Stream.concat(arguments.stream(), content.stream()).toArray(String[]::new))) {
            publisher.exitCode();
            return publisher.printed();
        }
    }

    private static int provisioned(Suite suite) throws Exception {
        HttpRequest request = HttpRequest.newBuilder(suite.devices().iotAgent().resolve("/iot/devices?limit=1"))
                .header("fiware-service", suite.fiwareService())
                .header("fiware-servicepath", "/")
                .build();
        return NgsiJson.read(HTTP.send(request, HttpResponse.BodyHandlers.ofByteArray())
                        .body())
                .path("count")
                .asInt();
    }
}
