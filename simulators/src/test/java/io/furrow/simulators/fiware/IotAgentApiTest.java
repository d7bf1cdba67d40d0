package io.furrow.simulators.fiware;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import static org.assertj.core.api.Assertions.assertThat;

class IotAgentApiTest {
    private static final String GROUP =
            "{\"services\": [{\"apikey\": \"k1\", \"resource\": \"/iot/json\", \"type\": \"Probe\"}]}";
    private static final String DEVICE = "{\"devices\": [{\"device_id\": \"d1\", \"commands\": [{\"name\": \"on\"}]}]}";

    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());
    private final Client client = Client.of(standIn.iotAgent());

    @AfterEach
    void stop() {
        standIn.close();
    }

    @Test
    void keepsServicesAndDevicesOfEachTenant() {
        assertThat(client.post("/iot/services", GROUP).status()).isEqualTo(201);
        assertThat(client.post("/iot/devices", DEVICE).status()).isEqualTo(201);

        assertThat(client.get("/iot/services")
                        .json()
                        .path("services")
                        .get(0)
                        .path("apikey")
                        .asText())
                .isEqualTo("k1");
        assertThat(client.get("/iot/devices").json().path("count").asInt()).isEqualTo(1);
        assertThat(client.get("/iot/devices/d1").json().path("entity_name").asText())
                .isEqualTo("Probe:d1");
        assertThat(client.as("other", "/plot1")
                        .get("/iot/devices")
                        .json()
                        .path("count")
                        .asInt())
                .isZero();

        assertThat(client.delete("/iot/devices/d1").status()).isEqualTo(204);
        assertThat(client.delete("/iot/services?resource=/iot/json&apikey=k1").status())
                .isEqualTo(204);
        assertThat(client.get("/iot/services").json().path("count").asInt()).isZero();
        assertThat(client.get("/iot/devices").json().path("count").asInt()).isZero();
    }

    @ParameterizedTest
    @CsvSource(
            delimiter = '|',
            quoteCharacter = '"',
            nullValues = "-",
            value = {
                "GET    | /iot/devices/none | -  | 404 | DEVICE_NOT_FOUND",
                "DELETE | /iot/devices/none | -  | 404 | DEVICE_NOT_FOUND",
                "DELETE | /iot/services?apikey=none | - | 404 | DEVICE_GROUP_NOT_FOUND",
                "POST   | /iot/devices      | {'devices':[{'device_id':'d1'}]} | 409 | DUPLICATE_DEVICE_ID",
                "POST   | /iot/services     | {'services':[{'apikey':'k1','resource':'/iot/json'}]} | 409 | DUPLICATE_GROUP",
                "POST   | /iot/devices      | {'devices':[{}]} | 400 | WRONG_SYNTAX",
                "POST   | /iot/services     | {} | 400 | WRONG_SYNTAX",
                "POST   | /iot/services     | {' | 400 | ParseError",
                "GET    | /iot/nothing      | -  | 404 | NOT_FOUND",
            })
    void refusesAsTheAgentDoes(String method, String path, String body, int status, String name) {
        client.post("/iot/services", GROUP);
        client.post("/iot/devices", DEVICE);

        Client.Answer answer = client.send(method, path, body == null ? "" : body.replace('\'', '"'));

        assertThat(answer.status()).as(answer.body()).isEqualTo(status);
        assertThat(answer.json().path("name").asText()).isEqualTo(name);
        assertThat(answer.json().path("message").asText()).isNotBlank();
    }

    @Test
    void wantsToKnowTheTenant() {
        Client.Answer answer = client.as("", "").get("/iot/devices");

        assertThat(answer.status()).isEqualTo(400);
        assertThat(answer.json().path("name").asText()).isEqualTo("MISSING_HEADERS");
    }

    @Test
    void saysThatACommandReachesNobodyWithoutMqtt() {
        client.post("/iot/services", GROUP);
        client.post("/iot/devices", DEVICE);
        Client broker = Client.of(standIn.contextBroker());

        broker.patch("/v2/entities/Probe:d1/attrs?options=keyValues", "{\"on\": 1}");

        assertThat(broker.get("/v2/entities/Probe:d1/attrs/on_status/value").body())
                .isEqualTo("\"ERROR\"");
    }
}
