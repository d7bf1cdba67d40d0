package io.furrow.control.rest;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.Test;

import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** Tests {@code /api/devices}. */
interface DeviceRoutes extends RestApiRoutes {
    @Test
    default void handlesDevicesAndCommandsToThem() throws Exception {
        client().send("POST", "/api/domains", "{\"domain\":\"south\"}");
        client().send("POST", "/api/missions", """
                {"mission": "hoeing", "domain": "south", "devices": [
                  {"type": "Thermometer", "count": 2, "simulated": true}, {"type": "Robot", "id": "robot-1"}, "urn:own:1"]}
                """);
        client().send("POST", "/api/missions/hoeing/start", null);
        String id = "urn:ngsi-ld:Thermometer:hoeing-1";
        checkAmbiguousId(id);
        assertThat(running().get("/api/devices?mission=hoeing&domain=south")).hasSize(4);
        assertThat(device(id).path("wanted").asText()).isEqualTo("running");

        checkConnection(id);
        checkCredentials(id);
        checkRotation(id);
        checkCommands(id);
        checkRejectedCommands(id);
        checkAudit(id);
    }

    private void checkConnection(String id) throws Exception {
        assertThat(device(id).has("connection")).isFalse();
        DeviceConnection connection = new DeviceConnection(
                1000L,
                null,
                new RefusedLogin(12, 2000, DeviceConnection.WRONG_PASSWORD, "furrow.d.hoeing.x.1.0"),
                null,
                new UnreadablePayload(1, 1500, "no JSON", "{"),
                true);

        String key = running().settings().missions().scope().identity(id);
        running().write(Topics.DEVICES_CONNECTION, key, connection.toBytes());

        await().until(() -> device(id).has("connection"));
        JsonNode shown = device(id).path("connection");
        assertThat(shown.at("/refusedLogin/count").asInt()).isEqualTo(12);
        assertThat(shown.at("/unreadablePayload/payload").asText()).isEqualTo("{");
        assertThat(shown.path("registered").asBoolean()).isTrue();
        assertThat(shown.path("cause").asText())
                .isEqualTo("its password was refused 12 times, last at 1970-01-01T00:00:02Z");
        assertThat(running().get("/api/devices?mission=hoeing").findValue("connection"))
                .isNull();
    }

    /** Two tenants may have the same id: a request must name the tenant, and is routed to it. */
    private void checkAmbiguousId(String id) throws Exception {
        FiwareScope other = new FiwareScope("other", "/north");
        byte[] device = new DeviceVersion(id, other.service(), other.servicePath(), "", "", 0, null, 1, null).toBytes();
        running().write(Topics.DEVICES, other.identity(id), device);

        await().untilAsserted(() -> running().rejects("GET", "/api/devices/" + id, null, 409, "ambiguous-device"));
        running().rejects("GET", "/api/devices/" + id + "/credentials", null, 409, "ambiguous-device");
        running().rejects("POST", "/api/devices/" + id + "/credentials", null, 409, "ambiguous-device");
        rejectsCommand(id, "{\"command\":\"on\",\"type\":\"T\"}", 409, "ambiguous-device");
        String named = "?service=other&servicePath=/north";
        assertThat(device(id + named).path("mission").asText()).isEmpty();
        running().rejects("POST", "/api/devices/" + id + "/credentials" + named, null, 404, "no-credentials");
        client().send("POST", "/api/devices/" + id + "/commands" + named, "{\"command\":\"on\",\"type\":\"Pump\"}");
        assertThat(running().broker().last()).contains("/attrs?type=Pump");
        assertThat(running().broker().scope()).isEqualTo("other /north");
        FiwareScope usual = running().settings().missions().scope();
        String scoped = "?service=" + usual.service() + "&servicePath=" + usual.servicePath();
        assertThat(device(id + scoped).path("mission").asText()).isEqualTo("hoeing");
        running().rejects("GET", "/api/devices/" + id + scoped + "&type=Pump", null, 404, "unknown-device");

        running().write(Topics.DEVICES, other.identity(id), null);
        await().untilAsserted(
                        () -> assertThat(device(id).path("mission").asText()).isEqualTo("hoeing"));
    }

    private void checkCredentials(String id) throws Exception {
        JsonNode credentials = device(id + "/credentials");
        assertThat(credentials.path("apiKey").asText()).isEqualTo(RunningApi.SECRET.apiKey("hoeing"));
        assertThat(credentials.path("password").asText())
                .isEqualTo(RunningApi.SECRET.device("hoeing", id).password());
        assertThat(credentials.path("generation").asInt()).isZero();
        running().rejects("GET", "/api/devices/urn:own:1/credentials", null, 404, "no-credentials");
        JsonNode real = running().get("/api/missions/hoeing/credentials");
        assertThat(real.findValuesAsText("device")).containsExactly("robot-1");
        assertThat(real.at("/0/measures").asText())
                .isEqualTo("/" + RunningApi.SECRET.apiKey("hoeing") + "/robot-1/attrs");
        assertThat(client().send("GET", "/api/devices/robot-1/credentials/qr", null)
                        .body())
                .asString()
                .startsWith("<svg");
        for (String path : List.of("/api/missions/hoeing/credentials", "/api/devices/robot-1/credentials")) {
            assertThat(client().send("GET", path, null, "Accept", "text/csv").body())
                    .asString()
                    .startsWith("device,deviceId,host,")
                    .contains("\r\nrobot-1,robot-1,")
                    .hasLineCount(2);
            assertThat(client().send("GET", path, null, "Accept", "application/json, */*")
                            .body())
                    .asString()
                    .contains("{\"device\":\"robot-1\"");
        }
        running().rejects("GET", "/api/missions/nosuch/credentials", null, 404, "unknown-mission");
    }

    private void checkRotation(String id) throws Exception {
        JsonNode rotated = client().ask("POST", "/api/devices/" + id + "/credentials", null);
        assertThat(rotated.path("password").asText())
                .isEqualTo(RunningApi.SECRET.device("hoeing", id, 1).password());
        assertThat(device(id + "/credentials")).isEqualTo(rotated);
        assertThat(device(id).path("generation").asInt()).isEqualTo(1);
        assertThat(running().get("/api/missions/hoeing").at("/status/devices").asInt())
                .isEqualTo(4);
        running().rejects("POST", "/api/devices/urn:own:1/credentials", null, 404, "no-credentials");
        running().rejects("POST", "/api/devices/nosuch/credentials", null, 404, "unknown-device");
    }

    private void checkCommands(String id) throws Exception {
        assertThat(client().status("POST", "/api/devices/" + id + "/commands", "{\"command\":\"restart\",\"value\":7}"))
                .isEqualTo(202);
        assertThat(running().broker().last())
                .contains("Thermometer%3Ahoeing-1")
                .endsWith("{\"restart\":{\"type\":\"command\",\"value\":7}}");
        client().send("POST", "/api/devices/robot-1/commands", "{\"command\":\"Stop\"}");
        assertThat(running().broker().last())
                .contains("robot-1/attrs?options=forcedUpdate {\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"}");
        client().send("POST", "/api/devices/" + id + "/commands", "{\"command\":\"on\",\"type\":\"ROBOT\"}");
        assertThat(running().broker().last()).contains("hoeing-1/attrs?type=Thermometer {\"on\":");
        for (String own : new String[] {"urn:own:1", "urn:on:no-mission"}) {
            assertThat(client().status(
                                    "POST",
                                    "/api/devices/" + own + "/commands",
                                    "{\"command\":\"Stop\",\"type\":\"ROBOT\"}"))
                    .as(own)
                    .isEqualTo(202);
            assertThat(running().broker().last())
                    .contains(own.replace(":", "%3A")
                            + "/attrs?options=forcedUpdate {\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"}");
        }
    }

    private void checkRejectedCommands(String id) throws Exception {
        for (int[] status : new int[][] {{400, 400}, {404, 404}, {409, 409}, {422, 422}, {403, 502}, {500, 502}}) {
            running().broker().answerWith(status[0]);
            rejectsCommand(id, "{\"command\":\"on\"}", status[1], "context-broker");
        }
        running().broker().answerWith(204);
        rejectsCommand("robot-1", "{\"command\":\"Stop\",\"value\":1}", 400, "wrong-member");
        rejectsCommand(id, "{\"command\":true}", 400, "wrong-member");
        rejectsCommand(id, "{\"value\":1}", 400, "missing-member");
        rejectsCommand(id, "{\"command\":\"a b\"}", 400, "wrong-member");
        rejectsCommand("urn:own:1", "{\"command\":\"on\"}", 400, "missing-member");
        running().rejects("GET", "/api/devices/nosuch", null, 404, "unknown-device");
        rejectsCommand("nosuch", "{\"command\":\"on\"}", 404, "unknown-device");
    }

    private void checkAudit(String id) throws Exception {
        await().untilAsserted(() -> assertThat(running().get("/api/audit?limit=1000"))
                .anyMatch(entry -> entry.path("command").asText().equals("Stop")
                        && entry.at("/about/device").asText().equals("robot-1")
                        && entry.path("user").asText().equals("rest")
                        && entry.path("result").asText().equals("sent"))
                .anyMatch(entry -> entry.path("command").asText().equals("restart")
                        && entry.at("/about/value").asText().equals("7"))
                .anyMatch(entry -> entry.path("command").asText().equals("credentials"))
                .anyMatch(entry -> entry.path("command").asText().equals("rotate-credentials")
                        && entry.at("/about/device").asText().equals(id)
                        && entry.path("result").asText().equals("rotated"))
                .anyMatch(entry -> entry.path("error").asText().equals("context-broker"))
                .anyMatch(entry -> entry.path("command").asText().equals("start")
                        && entry.at("/about/mission").asText().equals("hoeing")));
    }

    private JsonNode device(String path) throws Exception {
        return running().get("/api/devices/" + path);
    }

    private void rejectsCommand(String device, String body, int status, String error) throws Exception {
        running().rejects("POST", "/api/devices/" + device + "/commands", body, status, error);
    }
}
