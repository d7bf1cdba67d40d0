package io.furrow.fiware.agent;

import java.util.Map;

import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.Client;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.fiware.MqttDevice;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@Tag("full")
class MqttBridgeTest {
    private static final Map<String, String> PASSWORDS = Map.of("agent", "secret", "device", "hidden");

    @Test
    void refusesToStartWithAWrongPassword() {
        try (EmbeddedMqtt broker = EmbeddedMqtt.start(PASSWORDS)) {
            assertThatThrownBy(() -> FiwareStandIn.start(new FiwareSettings(0, 0, broker.uri(), "agent", "wrong")))
                    .isInstanceOf(IllegalStateException.class)
                    .hasMessageContainingAll(broker.uri().toString(), "password");
        }
    }

    @Test
    void comesBackWhenTheBrokerWasUnavailable() throws MqttException {
        EmbeddedMqtt first = EmbeddedMqtt.start(PASSWORDS);
        int port = first.uri().getPort();
        try (FiwareStandIn other = FiwareStandIn.start(new FiwareSettings(0, 0, first.uri(), "agent", "secret"))) {
            Client.of(other.iotAgent())
                    .post("/iot/services", "{\"services\": [{\"apikey\": \"k2\", \"resource\": \"/iot/json\"}]}");
            first.close();
            EmbeddedMqtt second = EmbeddedMqtt.start(port, PASSWORDS);
            MqttClient thing = MqttDevice.connect(second, "/k2/x/cmd", (topic, message) -> {});

            await().until(() -> {
                thing.publish("/k2/x/attrs", "{\"a\": 1}".getBytes(UTF_8), 1, false);
                return other.counters().measures() > 0;
            });

            thing.disconnect();
            thing.close();
            second.close();
        }
    }
}
