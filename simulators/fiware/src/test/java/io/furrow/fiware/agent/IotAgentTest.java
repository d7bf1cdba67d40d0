package io.furrow.fiware.agent;

import java.util.List;
import java.util.Map;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;
import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.Client;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.fiware.MqttDevice;
import io.furrow.fiware.NotificationReceiver;
import io.furrow.fiware.broker.NgsiTime;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class IotAgentTest {
    private static final String THERMOMETER = "/v2/entities/urn:ngsi-ld:Thermometer:1";

    private static final Map<String, String> PASSWORDS = Map.of("agent", "secret", "device", "hidden");

    /** One for all tests: its stop takes 2 s. */
    @AutoClose
    private static EmbeddedMqtt mqtt;

    private final FiwareStandIn standIn = FiwareStandIn.start(new FiwareSettings(0, 0, mqtt.uri(), "agent", "secret"));
    private final Client broker = Client.of(standIn.contextBroker());
    private final Client agent = Client.of(standIn.iotAgent());
    private final List<String> commands = new CopyOnWriteArrayList<>();
    private MqttClient device;

    @BeforeAll
    static void startBroker() {
        mqtt = EmbeddedMqtt.start(PASSWORDS);
    }

    @BeforeEach
    void provision() throws MqttException {
        Client.Answer group = agent.post("/iot/services", """
                {"services": [{"apikey": "k1", "resource": "/iot/json", "entity_type": "Probe"}]}""");
        assertThat(group.status()).as(group.body()).isEqualTo(201);
        Client.Answer provisioned = agent.post("/iot/devices", """
                {"devices": [{"device_id": "t1", "apikey": "k1", "entity_name": "urn:ngsi-ld:Thermometer:1",
                    "entity_type": "Thermometer", "protocol": "json", "transport": "MQTT",
                    "attributes": [{"object_id": "temp", "name": "Temperature", "type": "Float"},
                                   {"object_id": "time", "name": "Time", "type": "Integer"}],
                    "static_attributes": [{"name": "Domain", "type": "String", "value": "canary"}],
                    "commands": [{"name": "on", "type": "command"}]}]}""");
        assertThat(provisioned.status()).as(provisioned.body()).isEqualTo(201);
        device = MqttDevice.connect(
                mqtt, "/k1/t1/cmd", (topic, message) -> commands.add(new String(message.getPayload(), UTF_8)));
    }

    @AfterEach
    void stop() throws MqttException {
        standIn.close();
        device.disconnect();
        device.close();
    }

    @Test
    void turnsAMeasureIntoAnEntityAndANotification() throws MqttException {
        try (NotificationReceiver receiver = new NotificationReceiver()) {
            broker.post("/v2/subscriptions", """
                    {"subject": {"entities": [{"idPattern": ".*", "type": "Thermometer"}]},
                     "notification": {"http": {"url": "%s"}}}""".formatted(receiver.url("/notify")));

            publish("/k1/t1/attrs", "{\"temp\": 21.5, \"time\": 1795222800000, \"extra\": \"x\"}");

            await().until(() -> !receiver.received().isEmpty());
            JsonNode notified = receiver.received().get(0).json().path("data").get(0);
            assertThat(notified.path("id").asText()).isEqualTo("urn:ngsi-ld:Thermometer:1");
            assertThat(notified.at("/Temperature/type").asText()).isEqualTo("Float");
            assertThat(notified.at("/Temperature/value").asDouble()).isEqualTo(21.5);
            assertThat(notified.at("/Time/value").asLong()).isEqualTo(1795222800000L);
            assertThat(notified.at("/Domain/value").asText()).isEqualTo("canary");
            assertThat(notified.at("/extra/value").asText()).isEqualTo("x");
            JsonNode instant = notified.at("/TimeInstant/value");
            assertThat(NgsiTime.parse(instant.asText())).isPresent();
            assertThat(notified.at("/Temperature/metadata/TimeInstant/value")).isEqualTo(instant);
        }
    }

    @Test
    void takesAnUnknownDeviceOnlyWhereItsGroupLetsIt() throws MqttException {
        agent.post("/iot/services", """
                {"services": [{"apikey": "k2", "resource": "/iot/json", "entity_type": "Probe", "autoprovision": false}]}""");

        publish("/k2/stranger/attrs", "{\"temp\": 1}");
        publish("/k1/newcomer/attrs", "{\"temp\": 2}");

        awaitValue("/v2/entities/Probe:newcomer", "temp", "2");
        assertThat(broker.get("/v2/entities/Probe:stranger").status()).isEqualTo(404);
        assertThat(standIn.counters().measuresRefused()).isEqualTo(1);
    }

    @Test
    void retainsTheTimeInstantThatADeviceGives() throws MqttException {
        publish("/k1/t1/attrs", "{\"temp\": 1, \"TimeInstant\": \"2026-11-21T01:00:00Z\"}");

        awaitValue(THERMOMETER, "TimeInstant", "2026-11-21T01:00:00.000Z");
    }

    @Test
    void takesEachGoodMeasureOfAnArrayAndThePrefixedTopic() throws MqttException {
        try (NotificationReceiver receiver = new NotificationReceiver()) {
            broker.post("/v2/subscriptions", """
                    {"subject": {"entities": [{"idPattern": ".*", "type": "Thermometer"}]}, "notification": {
                        "http": {"url": "%s"}, "attrs": ["Temperature"], "attrsFormat": "values"}}""".formatted(receiver.url("/notify")));

            publish("/json/k1/t1/attrs", "[17, {\"temp\": 1}, {\"a b\": 1}, {\"temp\": 2}, {\"temp\": 3}]");

            await().until(() -> receiver.received().size() == 3);
            assertThat(receiver.received())
                    .extracting(one -> one.json().path("data").get(0).get(0).intValue())
                    .containsExactly(1, 2, 3);
            await().untilAsserted(() -> assertThat(standIn.history().of("k1", "t1"))
                    .hasValueSatisfying(history -> {
                        assertThat(history.measured()).isNotNull();
                        assertThat(history.ignored().reason())
                                .isEqualTo("a measure is a JSON object or an array of them");
                    }));
        }
    }

    @Test
    void registersADeviceThatNobodyProvisioned() throws MqttException {
        publish("/k1/new7/attrs", "{\"moisture\": 12}");

        awaitValue("/v2/entities/Probe:new7", "moisture", "12");
        assertThat(agent.get("/iot/devices/new7").json().path("entity_type").asText())
                .isEqualTo("Probe");
    }

    @Test
    void countsWhatItCannotUse() throws MqttException {
        publish("/unknown/t1/attrs", "{\"temp\": 1}");
        publish("/k1/t1/attrs", "{\"temp\":");
        publish("/k1/t1/attrs", "17");
        publish("/k1/t1/attrs", "{\"a b\": 1}");
        publish("/k1/t1/attrs", "{\"temp\": 5}");

        awaitValue(THERMOMETER, "Temperature", "5");
        assertThat(standIn.counters().measuresRefused()).isEqualTo(4);
        assertThat(standIn.counters().measures()).isEqualTo(1);
        MeasureHistory.Received received = standIn.history().of("k1", "t1").orElseThrow();
        assertThat(received.measured())
                .isGreaterThanOrEqualTo(received.ignored().last());
        assertThat(received.ignored().count()).isEqualTo(3);
        assertThat(received.ignored().payload()).isEqualTo("{\"a b\": 1}");
        assertThat(received.ignored().reason()).isEqualTo("Invalid characters in attribute name");
        assertThat(standIn.history().of("unknown", "t1").orElseThrow().ignored().reason())
                .contains("there is no device with this id and API key unknown");
    }

    @Test
    void sendsACommandAndShowsWhatBecameOfIt() throws MqttException {
        report();

        Client.Answer answer =
                broker.patch(THERMOMETER + "/attrs", "{\"on\": {\"type\": \"command\", \"value\": {\"level\": 2}}}");

        assertThat(answer.status()).as(answer.body()).isEqualTo(204);
        await().until(() -> commands.size() == 1);
        assertThat(commands).containsExactly("{\"on\":{\"level\":2}}");
        assertThat(broker.value("urn:ngsi-ld:Thermometer:1", "on_status")).hasToString("\"PENDING\"");

        publish("/k1/t1/cmdexe", "{\"on\": \"done\"}");

        awaitValue(THERMOMETER, "on_status", "OK");
        assertThat(broker.value("urn:ngsi-ld:Thermometer:1", "on_info")).hasToString("\"done\"");
        assertThat(broker.get("/v2/entities?type=Thermometer").json().path(0).has("on"))
                .isFalse();
    }

    @Test
    void takesCommandsFromTheFirstMeasureOn() throws MqttException {
        String command = "{\"on\": {\"type\": \"command\", \"value\": 1}}";
        assertThat(broker.patch(THERMOMETER + "/attrs", command).status()).isEqualTo(404);
        assertThat(broker.patch(THERMOMETER + "/attrs?type=Thermometer", command)
                        .status())
                .isEqualTo(404);

        report();

        assertThat(broker.get(THERMOMETER).json().at("/Domain/value").asText()).isEqualTo("canary");
        assertThat(broker.patch(THERMOMETER + "/attrs", command).status()).isEqualTo(204);
        await().until(() -> commands.size() == 1);
    }

    @Test
    void rejectsAMeasureAsAWholeThatTheContextBrokerWouldRefuse() throws MqttException {
        report();

        publish("/k1/t1/attrs", "{\"temp\": 22, \"note\": \"a=b\"}");
        publish("/k1/t1/attrs", "{\"temp\": 23, \"note\": {\"deep\": [\"(x)\"]}}");
        publish("/k1/t1/attrs", "{\"temp\": 24}");

        awaitValue(THERMOMETER, "Temperature", "24");
        assertThat(standIn.counters().measuresRefused()).isEqualTo(2);
        assertThat(broker.get(THERMOMETER).json().has("note")).isFalse();
    }

    /** Another name for the entity would make it unreadable for good. */
    @Test
    void givesNoAttributeANameThatTheEntityNeeds() throws MqttException {
        agent.post("/iot/devices", """
                {"devices": [{"device_id": "t2", "apikey": "k1", "entity_name": "T2", "entity_type": "Probe",
                    "attributes": [{"object_id": "t", "name": "type"}],
                    "static_attributes": [{"name": "id", "value": "zz"}], "commands": [{"name": "id"}]}]}""");

        publish("/k1/t2/attrs", "{\"id\": \"x\", \"type\": \"y\", \"t\": 3, \"servicePath\": \"/s\"}");
        publish("/k1/t2/attrs", "{\"temp\": 15}");

        awaitValue("/v2/entities/T2", "temp", "15");
        JsonNode entity = broker.get("/v2/entities/T2?options=keyValues&attrs=servicePath,*")
                .json();
        assertThat(entity.path("id").textValue()).isEqualTo("T2");
        assertThat(entity.path("type").textValue()).isEqualTo("Probe");
        assertThat(entity.path("servicePath").textValue()).isEqualTo("/plot1");
        assertThat(entity.path("measure_id").textValue()).isEqualTo("x");
        assertThat(entity.path("measure_type").textValue()).isEqualTo("y");
        assertThat(entity.path("measure_servicePath").textValue()).isEqualTo("/s");
        assertThat(entity.path("t").intValue()).isEqualTo(3);
    }

    @Test
    void findsADeviceOnlyThroughAGroupOfItsOwnResource() throws MqttException {
        for (String group : List.of("{'apikey': 'k3', 'resource': ''}", "{'apikey': 'k4', 'resource': '/iot/d'}")) {
            agent.post("/iot/services", "{\"services\": [" + group.replace('\'', '"') + "]}");
        }
        agent.post("/iot/devices", """
                {"devices": [{"device_id": "d3", "apikey": "k3"}, {"device_id": "d4", "apikey": "k4"},
                             {"device_id": "d5", "apikey": "k5"}]}""");

        for (int number = 3; number <= 5; number++) {
            publish("/k%d/d%d/attrs".formatted(number, number), "{\"temp\": 1}");
        }

        await().until(() -> standIn.counters().measuresRefused() == 3);
        agent.post("/iot/services", "{\"services\": [{\"apikey\": \"k5\", \"resource\": \"/iot/json\"}]}");
        publish("/k5/d5/attrs", "{\"temp\": 1}");
        awaitValue("/v2/entities/Thing:d5", "temp", "1");
    }

    @Test
    void sendsACommandHoweverItIsWritten() throws MqttException {
        report();
        broker.patch(THERMOMETER + "/attrs?type=Thermometer", "{\"on\": {\"type\": \"command\", \"value\": 1}}");
        broker.post(THERMOMETER + "/attrs?options=keyValues", "{\"on\": 2, \"Note\": \"mixed\"}");
        broker.post("/v2/op/update?options=keyValues", """
                {"actionType": "update", "entities": [
                    {"id": "urn:ngsi-ld:Thermometer:1", "type": "Thermometer", "on": 3}]}""");

        await().until(() -> commands.size() == 3);
        assertThat(commands).containsExactly("{\"on\":1}", "{\"on\":2}", "{\"on\":3}");
        assertThat(broker.value("urn:ngsi-ld:Thermometer:1", "Note")).hasToString("\"mixed\"");
    }

    /** Sends a first measure and waits until it is there. */
    private void report() throws MqttException {
        publish("/k1/t1/attrs", "{\"temp\": 21}");
        awaitValue(THERMOMETER, "Temperature", "21");
    }

    private void publish(String topic, String payload) throws MqttException {
        device.publish(topic, payload.getBytes(UTF_8), 1, false);
    }

    private void awaitValue(String entity, String attribute, String value) {
        await().untilAsserted(() -> assertThat(
                        broker.get(entity).json().path(attribute).path("value").asText())
                .isEqualTo(value));
    }
}
