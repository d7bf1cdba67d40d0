package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Duration;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.model.device.FarmSecret;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class RestApiIT {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final FarmSecret SECRET = new FarmSecret("a secret of sixteen bytes or more".getBytes());
    private static final String DEVICES =
            "[{\"type\":\"Thermometer\",\"count\":2},{\"type\":\"Robot\",\"id\":\"robot-1\"},\"urn:own:1\"]";

    private Path directory;

    private EmbeddedKafka kafka;
    private ControlPlane plane;
    private StubContextBroker broker;
    private RestApi api;
    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path temporary) throws Exception {
        directory = temporary;
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        broker = new StubContextBroker();
        plane = ControlPlane.start(settings());
        api = RestApi.start(
                settings(),
                RestSettings.on(0)
                        .withSecret(SECRET)
                        .withContextBroker(broker.uri())
                        .withPatience(Duration.ofSeconds(30)),
                plane::state);
        client = new ApiClient(api.uri(), null);
        await().atMost(Duration.ofSeconds(90))
                .until(() -> client.send("GET", "/health", null).statusCode() == 200);
    }

    /** Each route was asked at least once, and each answer was as it is described. */
    @AfterAll
    void stop() throws Exception {
        api.close();
        plane.close();
        broker.close();
        kafka.close();
        assertThat(ApiClient.ASKED).containsAll(OpenApiDocument.read().operations());
    }

    @Test
    void takesADomainFromItsBeginningToItsEnd() throws Exception {
        HttpResponse<byte[]> made = client.send("POST", "/api/domains", "{\"domain\":\"north\",\"name\":\"North\"}");
        assertThat(made.statusCode()).isEqualTo(201);
        assertThat(made.headers().firstValue("Location")).contains(api.uri() + "/api/domains/north");
        assertThat(json("GET", "/api/domains/north").path("name").asText()).isEqualTo("North");
        assertThat(client.send("PATCH", "/api/domains/north", "{\"description\":\"wet\"}")
                        .statusCode())
                .isEqualTo(200);
        assertThat(json("GET", "/api/domains").findValuesAsText("description")).contains("wet");

        refused("POST", "/api/domains", "{\"domain\":\"north\"}", 409, "domain-exists");
        assertThat(client.send("DELETE", "/api/domains/north", null).statusCode())
                .isEqualTo(200);
        refused("GET", "/api/domains/north", null, 404, "unknown-domain");
        refused("DELETE", "/api/domains/north?force=true", null, 404, "unknown-domain");
        refused("PATCH", "/api/domains/north", "{}", 404, "unknown-domain");
    }

    @Test
    void takesAMissionFromItsBeginningToItsEnd() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"south\"}");
        String mission = "{\"mission\":\"hoeing\",\"domain\":\"south\",\"devices\":%s}".formatted(DEVICES);
        assertThat(client.send("POST", "/api/missions", mission).statusCode()).isEqualTo(201);
        assertThat(json("GET", "/api/missions/hoeing").at("/status/state").asText())
                .isEqualTo("created");
        assertThat(client.send("POST", "/api/missions/hoeing/start", null).statusCode())
                .isEqualTo(200);
        JsonNode running = json("GET", "/api/missions/hoeing");
        assertThat(running.at("/status/state").asText()).isEqualTo("starting");
        assertThat(running.at("/status/devices").asInt()).isEqualTo(3);
        assertThat(running.path("devices")).hasSize(3);
        assertThat(json("GET", "/api/missions?domain=south").findValuesAsText("mission"))
                .contains("hoeing");
        assertThat(json("GET", "/api/missions?domain=nosuch")).isEmpty();

        refused("POST", "/api/missions/hoeing/start", "{}", 409, "mission-running");
        refused("DELETE", "/api/domains/south", null, 409, "missions-running");
        devices();
        assertThat(client.send("POST", "/api/missions/hoeing/stop", null).statusCode())
                .isEqualTo(200);
        refused("DELETE", "/api/missions/hoeing", null, 409, "mission-running");
        refused("GET", "/api/missions/nosuch", null, 404, "unknown-mission");
        refused("POST", "/api/missions/nosuch/stop", null, 404, "unknown-mission");
        refused("DELETE", "/api/missions/nosuch", null, 404, "unknown-mission");
        refused("POST", "/api/missions", "{\"mission\":\"a.b\",\"domain\":\"south\"}", 400, "illegal-name");
    }

    private void devices() throws Exception {
        String id = "urn:ngsi-ld:Thermometer:hoeing-1";
        assertThat(json("GET", "/api/devices?mission=hoeing&domain=south")).hasSize(4);
        assertThat(json("GET", "/api/devices/" + id).path("wanted").asText()).isEqualTo("running");

        JsonNode credentials = json("GET", "/api/devices/" + id + "/credentials");
        assertThat(credentials.path("apiKey").asText()).isEqualTo(SECRET.apiKey("hoeing"));
        assertThat(credentials.path("password").asText())
                .isEqualTo(SECRET.device("hoeing", id).password());
        refused("GET", "/api/devices/urn:own:1/credentials", null, 404, "no-credentials");

        assertThat(client.send("POST", "/api/devices/" + id + "/commands", "{\"command\":\"restart\",\"value\":7}")
                        .statusCode())
                .isEqualTo(202);
        assertThat(broker.last())
                .contains("Thermometer%3Ahoeing-1")
                .endsWith("{\"restart\":{\"type\":\"command\",\"value\":\"7\"}}");
        client.send("POST", "/api/devices/robot-1/commands", "{\"command\":\"Stop\"}");
        assertThat(broker.last()).endsWith("{\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"}}");
        broker.refuse(404);
        refused("POST", "/api/devices/" + id + "/commands", "{\"command\":\"on\"}", 502, "context-broker");
        broker.refuse(204);
        refused("POST", "/api/devices/" + id + "/commands", "{\"value\":1}", 400, "missing-member");
        refused("POST", "/api/devices/" + id + "/commands", "{\"command\":\"a b\"}", 400, "wrong-member");
        refused("POST", "/api/devices/urn:own:1/commands", "{\"command\":\"on\"}", 400, "missing-member");
        refused("GET", "/api/devices/nosuch", null, 404, "unknown-device");
        refused("POST", "/api/devices/nosuch/commands", "{\"command\":\"on\"}", 404, "unknown-device");

        await().atMost(PATIENCE)
                .untilAsserted(() -> assertThat(json("GET", "/api/audit?limit=1000"))
                        .anyMatch(entry -> entry.path("command").asText().equals("Stop")
                                && entry.at("/about/device").asText().equals("robot-1")
                                && entry.path("user").asText().equals("rest")
                                && entry.path("result").asText().equals("sent"))
                        .anyMatch(entry -> entry.path("error").asText().equals("context-broker"))
                        .anyMatch(entry -> entry.path("command").asText().equals("start")
                                && entry.at("/about/mission").asText().equals("hoeing")));
    }

    @Test
    void keepsTemplatesByVersion() throws Exception {
        String template = "{\"template\":\"t\",\"devices\":[{\"type\":\"Thermometer\",\"count\":3}]}";
        client.send("POST", "/api/templates", template);
        JsonNode second = client.json(client.send("POST", "/api/templates", template));
        assertThat(second.path("version").asInt()).isEqualTo(2);
        assertThat(json("GET", "/api/templates/t").path("version").asInt()).isEqualTo(2);
        assertThat(json("GET", "/api/templates/t@1").path("version").asInt()).isEqualTo(1);
        assertThat(json("GET", "/api/templates").findValuesAsText("template")).contains("t", "thesis-demo");

        String exported = json("GET", "/api/templates/thesis-demo").toString();
        assertThat(client.json(client.send("POST", "/api/templates", exported))
                        .path("version")
                        .asInt())
                .isEqualTo(2);
        assertThat(client.send("DELETE", "/api/templates/t@2", null).statusCode())
                .isEqualTo(200);
        assertThat(json("GET", "/api/templates/t").path("version").asInt()).isEqualTo(1);
        assertThat(client.send("DELETE", "/api/templates/t", null).statusCode()).isEqualTo(200);
        refused("GET", "/api/templates/t", null, 404, "unknown-template");
        refused("DELETE", "/api/templates/t@1", null, 404, "unknown-template");
        refused("DELETE", "/api/templates/t@x", null, 404, "unknown-template");
    }

    @Test
    void steersReplays() throws Exception {
        JsonNode made = client.json(client.send("POST", "/api/replays", "{\"mission\":\"hoeing\",\"speed\":\"max\"}"));
        String replay = "/api/replays/" + made.path("replay").asText();
        assertThat(json("GET", replay).path("wanted").asText()).isEqualTo("running");
        assertThat(client.json(client.send("POST", replay + "/pause", null))
                        .path("status")
                        .asText())
                .isEqualTo("paused");
        assertThat(client.send("POST", replay + "/step", "{\"count\":3}").statusCode())
                .isEqualTo(200);
        assertThat(client.send("POST", replay + "/seek", "{\"to\":1700000000000}")
                        .statusCode())
                .isEqualTo(200);
        assertThat(client.send("POST", replay + "/speed", "{\"speed\":2}").statusCode())
                .isEqualTo(200);
        assertThat(client.send("POST", replay + "/resume", null).statusCode()).isEqualTo(200);
        assertThat(json("GET", "/api/replays").findValuesAsText("replay"))
                .contains(made.path("replay").asText());
        refused("POST", replay + "/step", "{}", 409, "wrong-state");
        refused("POST", replay + "/dance", null, 404, "not-found");
        assertThat(client.send("DELETE", replay, null).statusCode()).isEqualTo(200);
        refused("GET", "/api/replays/hoeing.00000000", null, 404, "unknown-replay");
    }

    @Test
    void givesTheSameKeyOneEffectAndTheSameAnswer() throws Exception {
        String body = "{\"domain\":\"once\"}";
        HttpResponse<byte[]> first = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        HttpResponse<byte[]> again = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        assertThat(first.statusCode()).isEqualTo(201);
        assertThat(again.statusCode()).isEqualTo(201);
        assertThat(again.body()).isEqualTo(first.body());

        try (RestApi other = RestApi.start(settings(), RestSettings.on(0), () -> "RUNNING")) {
            ApiClient there = new ApiClient(other.uri(), null);
            await().atMost(PATIENCE)
                    .until(() -> there.send("GET", "/health", null).statusCode() == 200);
            assertThat(there.send("POST", "/api/domains", body, "Idempotency-Key", "key-1")
                            .body())
                    .isEqualTo(first.body());
            assertThat(there.send("POST", "/api/domains", body).statusCode()).isEqualTo(409);
        }
    }

    @Test
    void saysWhatIsWrongWithARequest() throws Exception {
        refused("POST", "/api/domains", "{\"domain\":", 400, "not-json");
        refused("POST", "/api/domains", "[]", 400, "not-a-request");
        refused("POST", "/api/domains", "{\"domain\":\"\\ud800\"}", 400, "not-json");
        refused("POST", "/api/domains", "{}", 400, "missing-member");
        refused("POST", "/api/domains", "{\"domain\":\"x\",\"name\":7}", 400, "wrong-member");
        refused("GET", "/api/audit?limit=0", null, 400, "wrong-member");
        assertThat(error(client.send("GET", "/api/nosuch", null, false))).isEqualTo("404 not-found");
        assertThat(error(client.send("PUT", "/api/domains", "{}", false))).isEqualTo("405 method-not-allowed");
        assertThat(error(client.send("POST", "/api/domains", "{}", "Content-Type", "text/plain")))
                .isEqualTo("415 unsupported-media-type");
        assertThat(error(client.send("POST", "/api/domains", "{}", "Idempotency-Key", "a b")))
                .isEqualTo("400 wrong-header");
        assertThat(error(client.send("POST", "/api/domains", "{}", "Origin", "http://evil.example")))
                .isEqualTo("403 foreign-origin");
        assertThat(client.raw("/api/domains", "evil.example")).contains(" 403 ", "foreign-host");
        assertThat(client.raw("/api/domains/a%2Fb", "localhost"))
                .contains(" 400 ", "{\"type\":\"response\",\"status\":\"error\"");
        byte[] large = new byte[9 * 1024 * 1024];
        java.util.Arrays.fill(large, (byte) ' ');
        assertThat(error(client.send("POST", "/api/domains", new String(large))))
                .isEqualTo("413 too-large");
    }

    @Test
    void tellsOfItself() throws Exception {
        assertThat(json("GET", "/openapi.json"))
                .isEqualTo(OpenApiDocument.read().json());
        assertThat(json("GET", "/api/alarms?state=open")).isEmpty();
        assertThat(json("GET", "/api/audit").size()).isLessThanOrEqualTo(100);
        assertThat(new String(client.send("GET", "/metrics", null).body()))
                .contains("furrow_control_view_complete 1", "path=\"/api/alarms\"");
    }

    @Test
    void asksForATokenWhereItHasSome() throws Exception {
        Path tokens = directory.resolve("tokens");
        java.nio.file.Files.writeString(tokens, "# who may\nann a-token-of-sixteen-signs\n");
        try (RestApi other = RestApi.start(settings(), RestSettings.on(0).withTokens(tokens), () -> "RUNNING")) {
            ApiClient nobody = new ApiClient(other.uri(), null);
            ApiClient ann = new ApiClient(other.uri(), "a-token-of-sixteen-signs");
            await().atMost(PATIENCE)
                    .until(() -> nobody.send("GET", "/health", null).statusCode() == 200);
            for (String path :
                    new String[] {"/api/domains", "//api/domains", "/api/../api/domains", "/api;x/domains"}) {
                assertThat(nobody.raw(path, "localhost")).as(path).containsAnyOf(" 401 ", " 400 ");
            }
            assertThat(error(nobody.send("GET", "/api/domains", null))).isEqualTo("401 unauthorized");
            assertThat(error(new ApiClient(other.uri(), "another-token-of-signs").send("GET", "/api/domains", null)))
                    .isEqualTo("401 unauthorized");
            assertThat(ann.send("GET", "/api/domains", null).statusCode()).isEqualTo(200);
            ann.send("POST", "/api/domains", "{\"domain\":\"ann-s\",\"user\":\"bob\"}");
        }
        await().atMost(PATIENCE)
                .untilAsserted(() -> assertThat(json("GET", "/api/audit?limit=1000"))
                        .anyMatch(entry -> entry.path("user").asText().equals("ann")
                                && entry.at("/about/domain").asText().equals("ann-s")));
    }

    /** The alarms' manager does not run here. */
    @Test
    void saysThatNobodyAnsweredAndHowToAskAgain() throws Exception {
        try (RestApi other = RestApi.start(
                settings(), RestSettings.on(0).withPatience(Duration.ofMillis(300)), () -> "REBALANCING")) {
            ApiClient there = new ApiClient(other.uri(), null);
            await().atMost(PATIENCE).until(other::isReady);
            assertThat(there.send("GET", "/health", null).statusCode()).isEqualTo(503);
            for (String path : new String[] {"/api/alarms/a-1/mute", "/api/alarms/mute"}) {
                HttpResponse<byte[]> answer = there.send("POST", path, "{}", "Idempotency-Key", "again");
                assertThat(error(answer)).isEqualTo("503 not-answered");
                assertThat(answer.headers().firstValue("Retry-After")).contains("1");
                assertThat(there.json(answer).path("reason").asText()).contains("Idempotency-Key: again");
            }
        }
    }

    private JsonNode json(String method, String path) throws Exception {
        HttpResponse<byte[]> answer = client.send(method, path, null);
        assertThat(answer.statusCode()).as(path).isEqualTo(200);
        return client.json(answer);
    }

    private void refused(String method, String path, String body, int status, String error) throws Exception {
        boolean described = !error.equals("not-found");
        assertThat(error(client.send(method, path, body, described))).isEqualTo(status + " " + error);
    }

    private String error(HttpResponse<byte[]> answer) throws Exception {
        return answer.statusCode() + " " + client.json(answer).path("error").asText();
    }

    private ControlSettings settings() {
        Properties kafkaClient = new Properties();
        kafkaClient.setProperty("bootstrap.servers", kafka.bootstrapServers());
        kafkaClient.setProperty("state.dir", directory.resolve("state").toString());
        return ControlSettings.of(kafkaClient);
    }
}
