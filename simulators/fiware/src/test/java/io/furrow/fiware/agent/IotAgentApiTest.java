package io.furrow.fiware.agent;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.fiware.Client;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;

import static org.assertj.core.api.Assertions.assertThat;

class IotAgentApiTest {
    private static final String GROUP =
            "{\"services\": [{\"apikey\": \"k1\", \"resource\": \"/iot/json\", \"type\": \"Probe\"}]}";
    private static final String DEVICE = "{\"devices\": [{\"device_id\": \"d1\", \"commands\": [{\"name\": \"on\"}]}]}";

    @AutoClose
    private final FiwareStandIn standIn = FiwareStandIn.start(FiwareSettings.httpOnly());

    private final Client client = Client.of(standIn.iotAgent());

    @Test
    void retainsServicesAndDevicesOfEachTenant() {
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
        assertThat(client.get("/iot/services").status()).isEqualTo(404);
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
                "DELETE | /iot/services?apikey=none&resource= | - | 404 | DEVICE_GROUP_NOT_FOUND",
                "DELETE | /iot/services?apikey=k1&resource= | - | 404 | DEVICE_GROUP_NOT_FOUND",
                "DELETE | /iot/services?apikey=k1 | - | 400 | MISSING_HEADERS",
                "PUT    | /iot/services?resource=/iot/json | {} | 400 | MISSING_HEADERS",
                "POST   | /iot/devices      | {'devices':[{'device_id':'d1'}]} | 409 | DUPLICATE_DEVICE_ID",
                "POST   | /iot/services     | {'services':[{'apikey':'k1','resource':'/iot/json'}]} | 409 | DUPLICATE_GROUP",
                "POST   | /iot/devices      | {'devices':[{}]} | 400 | MISSING_ATTRIBUTES",
                "POST   | /iot/devices      | {} | 400 | WRONG_SYNTAX",
                "POST   | /iot/services     | {} | 400 | WRONG_SYNTAX",
                "POST   | /iot/services     | {' | 500 | SyntaxError",
            })
    void rejectsAsTheAgentDoes(String method, String path, String body, int status, String name) {
        client.post("/iot/services", GROUP);
        client.post("/iot/devices", DEVICE);

        Client.Answer answer = client.send(method, path, body == null ? "" : body.replace('\'', '"'));

        assertThat(answer.status()).as(answer.body()).isEqualTo(status);
        assertThat(answer.json().path("name").asText()).isEqualTo(name);
        assertThat(answer.json().path("message").asText()).isNotBlank();
    }

    @Test
    void requiresTheTenant() {
        Client.Answer answer = client.as("", "").get("/iot/devices");

        assertThat(answer.status()).isEqualTo(400);
        assertThat(answer.json().path("name").asText()).isEqualTo("MISSING_HEADERS");
    }

    @Test
    void reportsWhichHeaderIsMissing() {
        Client.Answer answer = client.as("", "").with("fiware-service", "farm").get("/iot/devices");

        assertThat(answer.json().path("message").asText()).endsWith("[\"fiware-servicepath\"]");
    }

    @Test
    void answersWithAPageWhatItHasNoRouteFor() {
        assertThat(client.get("/iot/nothing").body()).contains("<pre>Cannot GET /iot/nothing</pre>");
        assertThat(client.send("PATCH", "/iot/devices", "{}").body()).contains("<pre>Cannot PATCH /iot/devices</pre>");
    }

    @Test
    void makesTheOtherDevicesOfABatchOfWhichOneIsRefused() {
        client.post("/iot/devices", DEVICE);

        Client.Answer answer = client.post(
                "/iot/devices",
                "{\"devices\": [{\"device_id\": \"d0\"}, {\"device_id\": \"d1\"}, {\"device_id\": \"d2\"}]}");

        assertThat(answer.status()).isEqualTo(409);
        assertThat(client.get("/iot/devices").json().findValuesAsText("device_id"))
                .containsExactly("d1", "d0", "d2");
    }

    @Test
    void listsAllGroupsOfATenantWhateverPageIsRequested() {
        for (int i = 0; i < 3; i++) {
            client.post("/iot/services", "{\"services\": [{\"apikey\": \"k%d\", \"resource\": \"\"}]}".formatted(i));
        }

        assertThat(client.get("/iot/services?limit=1&offset=2").json().path("services"))
                .hasSize(3);
    }

    @Test
    void listsADeviceWhateverItsListsHold() {
        client.post(
                "/iot/devices", "{\"devices\": [{\"device_id\": \"odd\", \"lazy\": [1], \"static_attributes\": {}}]}");

        assertThat(client.get("/iot/devices/odd").json().path("lazy").toString())
                .isEqualTo("[1]");
    }

    @Test
    void retainsOneGroupOfAResourceAndAKeyInAllTenants() {
        client.post("/iot/services", GROUP);

        assertThat(client.as("other", "/").post("/iot/services", GROUP).status())
                .isEqualTo(409);
        assertThat(client.post("/iot/services", GROUP.replace("/iot/json", "")).status())
                .isEqualTo(201);
    }

    @Test
    void reportsThatACommandReachesNobodyWithoutMqtt() {
        client.post("/iot/services", GROUP);
        client.post("/iot/devices", DEVICE);
        Client broker = Client.of(standIn.contextBroker());
        broker.post("/v2/entities", "{\"id\": \"Probe:d1\", \"type\": \"Probe\"}");

        broker.patch("/v2/entities/Probe:d1/attrs?options=keyValues", "{\"on\": 1}");

        assertThat(broker.value("Probe:d1", "on_status")).hasToString("\"ERROR\"");
    }
}
