package io.furrow.suite;

import java.net.URI;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.launcher.suite.Suite;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** The thermometer of the README, with the clients that a user would use. */
@Tag("full")
class RealClientsIT {
    private static final String ENTITY = "urn:ngsi-ld:Thermometer:mine";
    private static final String GROUP = """
            {"services": [{"apikey": "secret", "resource": "/iot/json", "entity_type": "Thing"}]}""";
    private static final String DEVICE = """
            {"devices": [{"device_id": "mine", "apikey": "secret", "entity_name": "urn:ngsi-ld:Thermometer:mine",
              "entity_type": "Thermometer", "transport": "MQTT", "commands": [{"name": "on", "type": "command"}],
              "attributes": [{"object_id": "temp", "name": "Temperature", "type": "Float"},
                             {"object_id": "lat", "name": "Latitude", "type": "Float"},
                             {"object_id": "lon", "name": "Longitude", "type": "Float"}],
              "static_attributes": [{"name": "Domain", "type": "String", "value": "farm"}]}]}
            """;

    @AutoClose
    private static RunningSuite running;

    @BeforeAll
    static void startAndProvision() throws Exception {
        running = RunningSuite.start(null);
        curl("POST", running.suite().devices().iotAgent().resolve("/iot/services"), GROUP);
        curl("POST", running.suite().devices().iotAgent().resolve("/iot/devices"), DEVICE);
    }

    @Test
    void routesAMeasureOfMosquittoPubToTheDomainsTopic() throws Exception {
        report();
        try (TopicLog topic = running.topic("data.farm.realtime")) {
            await().untilAsserted(() -> assertThat(topic.of(ENTITY))
                    .extracting(record ->
                            Entity.parse(record.value()).number("Temperature").orElse(0.0))
                    .contains(21.5));
        }
    }

    @Test
    void sendsACommandOfCurlToTheDeviceAndItsAnswerBack() throws Exception {
        report();
        URI attributes = running.suite().contextBroker().resolve("/v2/entities/" + ENTITY + "/attrs");
        try (Command device =
                Command.start(mosquitto("mosquitto_sub", Suite.MQTT_PASSWORD, "/secret/mine/cmd", "-C", "1", "-d"))) {
            await().until(() -> device.printed().contains("SUBACK"));

            curl("PATCH", attributes, "{\"on\": {\"type\": \"command\", \"value\": \"now\"}}");

            assertThat(device.exitCode()).isZero();
            assertThat(device.printed()).contains("{\"on\":\"now\"}");
        }
        assertThat(entity().at("/on_status/value").asText()).isEqualTo("PENDING");

        Command.run(
                mosquitto("mosquitto_pub", Suite.MQTT_PASSWORD, "/secret/mine/cmdexe", "-m", "{\"on\": \"is on\"}"));

        await().untilAsserted(() -> {
            assertThat(entity().at("/on_status/value").asText()).isEqualTo("OK");
            assertThat(entity().at("/on_info/value").asText()).isEqualTo("is on");
        });
    }

    @Test
    void rejectsAWrongPassword() throws Exception {
        try (Command publisher =
                Command.start(mosquitto("mosquitto_pub", "guessed", "/secret/mine/attrs", "-m", "{\"temp\": 99}"))) {
            assertThat(publisher.exitCode()).isNotZero();
            assertThat(publisher.printed()).contains("bad user name or password");
        }
    }

    /** A device accepts commands once it has sent a measure. */
    private static void report() throws Exception {
        Command.run(mosquitto(
                "mosquitto_pub",
                Suite.MQTT_PASSWORD,
                "/secret/mine/attrs",
                "-m",
                "{\"temp\": 21.5, \"lat\": 40.3134, \"lon\": -3.483}"));

        await().untilAsserted(() ->
                assertThat(entity().at("/Temperature/value").asDouble()).isEqualTo(21.5));
    }

    private static JsonNode entity() throws Exception {
        return running.ngsi().entity(ENTITY);
    }

    private static void curl(String method, URI uri, String body) throws Exception {
        Command.run(
                "curl",
                "--silent",
                "--show-error",
                "--fail-with-body",
                "-X",
                method,
                uri.toString(),
                "-H",
                "fiware-service: farm",
                "-H",
                "fiware-servicepath: /",
                "-H",
                "Content-Type: application/json",
                "-d",
                body);
    }

    private static String[] mosquitto(String program, String password, String topic, String... more) {
        URI broker = running.suite().devices().mqtt();
        List<String> arguments =
                new ArrayList<>(List.of("stdbuf", "-oL", program)); // line buffering, though the output is no terminal
        arguments.addAll(List.of("-h", broker.getHost(), "-p", Integer.toString(broker.getPort())));
        arguments.addAll(List.of("-u", Suite.MQTT_USER, "-P", password, "-q", "1", "-t", topic));
        arguments.addAll(List.of(more));
        return arguments.toArray(String[]::new);
    }
}
