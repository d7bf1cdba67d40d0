package io.furrow.cli.control.table;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

class CredentialListTest {
    private static final String DEVICE = """
            {"device": "urn:t:1", "deviceId": "it's", "host": "farm.lan", "port": 8883, "tls": true, "user": "u", "password": "p,1",
             "apiKey": "k", "measures": "/k/t/attrs", "commands": "/k/t/cmd", "results": "/k/t/cmdexe",
             "attributes": [{"object_id": "t", "name": "Temperature"}, {"object_id": "bat", "name": "battery"}],
             "example": "mosquitto_pub -m '{\\"t\\":21}'"}""";

    @Test
    void writesVariablesThatAShellReads() throws Exception {
        assertThat(CredentialList.env(devices()))
                .contains(
                        "MQTT_HOST='farm.lan'",
                        "MQTT_DEVICE_ID='it'\\''s'",
                        "MQTT_MEASURES='/k/t/attrs'",
                        "MQTT_ATTRIBUTES='t=Temperature bat=battery'");
    }

    private static JsonNode devices() throws Exception {
        return NgsiJson.mapper().createArrayNode().add(NgsiJson.mapper().readTree(DEVICE));
    }
}
