package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.IntStream;

import com.fasterxml.jackson.databind.JsonNode;
import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.Readiness;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceConnection.UnreadablePayload;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class RestApiIT {
    private static final String DEVICES =
            "[{\"type\":\"Thermometer\",\"count\":2,\"simulated\":true},{\"type\":\"Robot\",\"id\":\"robot-1\"},\"urn:own:1\"]";

    private RunningApi running;
    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        client = running.client();
    }

    /** Each route was asked at least once, and each answer was as it is described. */
    @AfterAll
    void stop() throws Exception {
        running.close();
        assertThat(ApiClient.REQUESTED).containsAll(OpenApiDocument.read().operations());
    }

    /** More of these is in tests of their own. */
    @Test
    void reportsWhoRequestsAndWhatIsNotThere() throws Exception {
        assertThat(client.status("GET", "/api/me", null)).isEqualTo(200);
        assertThat(client.status("HEAD", "/api/replays/events", null)).isEqualTo(200);
        assertThat(client.status("HEAD", "/api/replays/none.1/events", null))
                .isEqualTo(200); // of an answer without an end only the form is told
        running.refused("GET", "/api/recordings/none/timeline", null, 501, "no-mongodb");
    }

    @Test
    void takesADomainFromItsBeginningToItsEnd() throws Exception {
        HttpResponse<byte[]> made = client.send("POST", "/api/domains", "{\"domain\":\"north\",\"name\":\"North\"}");
        assertThat(made.statusCode()).isEqualTo(201);
        assertThat(made.headers().firstValue("Location")).contains(running.api().uri() + "/api/domains/north");
        assertThat(running.get("/api/domains/north").path("name").asText()).isEqualTo("North");
        assertThat(client.status("PATCH", "/api/domains/north", "{\"description\":\"wet\"}"))
                .isEqualTo(200);
        assertThat(running.get("/api/domains").findValuesAsText("description")).contains("wet");

        running.refused("POST", "/api/domains", "{\"domain\":\"north\"}", 409, "domain-exists");
        assertThat(client.status("DELETE", "/api/domains/north", null)).isEqualTo(200);
        running.refused("GET", "/api/domains/north", null, 404, "unknown-domain");
        running.refused("DELETE", "/api/domains/north?force=true", null, 404, "unknown-domain");
        running.refused("PATCH", "/api/domains/north", "{}", 404, "unknown-domain");
    }

    @Test
    void takesAMissionFromItsBeginningToItsEnd() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"south\"}");
        String mission = "{\"mission\":\"hoeing\",\"domain\":\"south\",\"devices\":%s}".formatted(DEVICES);
        assertThat(client.status("POST", "/api/missions", mission)).isEqualTo(201);
        assertThat(running.get("/api/missions/hoeing").at("/status/state").asText())
                .isEqualTo("created");
        assertThat(client.status("POST", "/api/missions/hoeing/start", null)).isEqualTo(200);
        JsonNode started = running.get("/api/missions/hoeing");
        assertThat(started.at("/status/state").asText()).isEqualTo("starting");
        assertThat(started.at("/status/devices").asInt()).isEqualTo(4);
        assertThat(started.path("devices")).hasSize(3);
        assertThat(running.get("/api/missions?domain=south").findValuesAsText("mission"))
                .contains("hoeing");
        assertThat(running.get("/api/missions?domain=nosuch")).isEmpty();

        running.refused("POST", "/api/missions/hoeing/start", "{}", 409, "mission-running");
        running.refused("DELETE", "/api/domains/south", null, 409, "missions-running");
        devices();
        assertThat(client.status("POST", "/api/missions/hoeing/stop", null)).isEqualTo(200);
        running.refused("DELETE", "/api/missions/hoeing", null, 409, "mission-running");
        running.refused("GET", "/api/missions/nosuch", null, 404, "unknown-mission");
        running.refused("POST", "/api/missions/nosuch/stop", null, 404, "unknown-mission");
        running.refused("DELETE", "/api/missions/nosuch", null, 404, "unknown-mission");
        running.refused("POST", "/api/missions", "{\"mission\":\"a.b\",\"domain\":\"south\"}", 400, "illegal-name");
    }

    private void connection(String id) throws Exception {
        assertThat(running.get("/api/devices/" + id).has("connection")).isFalse();
        DeviceConnection connection = new DeviceConnection(
                1000L,
                null,
                new RefusedLogin(12, 2000, DeviceConnection.WRONG_PASSWORD, "furrow.d.hoeing.x.1.0"),
                null,
                new UnreadablePayload(1, 1500, "no JSON", "{"),
                true);

        String key = running.settings().missions().scope().identity(id);
        running.write(Topics.DEVICES_CONNECTION, key, connection.toBytes());

        await().until(() -> running.get("/api/devices/" + id).has("connection"));
        JsonNode shown = running.get("/api/devices/" + id).path("connection");
        assertThat(shown.at("/refusedLogin/count").asInt()).isEqualTo(12);
        assertThat(shown.at("/unreadablePayload/payload").asText()).isEqualTo("{");
        assertThat(shown.path("registered").asBoolean()).isTrue();
        assertThat(shown.path("cause").asText())
                .isEqualTo("its password was refused 12 times, last at 1970-01-01T00:00:02Z");
        assertThat(running.get("/api/devices?mission=hoeing").findValue("connection"))
                .isNull();
    }

    /** Two tenants may have one id: a request has to say which is meant, and goes there. */
    private void sameIdInAnotherTenant(String id) throws Exception {
        FiwareScope other = new FiwareScope("other", "/north");
        byte[] device = new DeviceVersion(id, other.service(), other.servicePath(), "", "", 0, null, 1, null).toBytes();
        running.write(Topics.DEVICES, other.identity(id), device);

        await().untilAsserted(() -> running.refused("GET", "/api/devices/" + id, null, 409, "ambiguous-device"));
        running.refused("GET", "/api/devices/" + id + "/credentials", null, 409, "ambiguous-device");
        running.refused("POST", "/api/devices/" + id + "/credentials", null, 409, "ambiguous-device");
        running.refused(
                "POST",
                "/api/devices/" + id + "/commands",
                "{\"command\":\"on\",\"type\":\"T\"}",
                409,
                "ambiguous-device");
        String named = "?service=other&servicePath=/north";
        assertThat(running.get("/api/devices/" + id + named).path("mission").asText())
                .isEmpty();
        running.refused("POST", "/api/devices/" + id + "/credentials" + named, null, 404, "no-credentials");
        client.send("POST", "/api/devices/" + id + "/commands" + named, "{\"command\":\"on\",\"type\":\"Pump\"}");
        assertThat(running.broker().last()).contains("/attrs?type=Pump");
        assertThat(running.broker().scope()).isEqualTo("other /north");
        FiwareScope usual = running.settings().missions().scope();
        String there = "?service=" + usual.service() + "&servicePath=" + usual.servicePath();
        assertThat(running.get("/api/devices/" + id + there).path("mission").asText())
                .isEqualTo("hoeing");
        running.refused("GET", "/api/devices/" + id + there + "&type=Pump", null, 404, "unknown-device");

        running.write(Topics.DEVICES, other.identity(id), null);
        await().untilAsserted(() -> assertThat(
                        running.get("/api/devices/" + id).path("mission").asText())
                .isEqualTo("hoeing"));
    }

    private void devices() throws Exception {
        String id = "urn:ngsi-ld:Thermometer:hoeing-1";
        sameIdInAnotherTenant(id);
        assertThat(running.get("/api/devices?mission=hoeing&domain=south")).hasSize(4);
        assertThat(running.get("/api/devices/" + id).path("wanted").asText()).isEqualTo("running");

        connection(id);
        JsonNode credentials = running.get("/api/devices/" + id + "/credentials");
        assertThat(credentials.path("apiKey").asText()).isEqualTo(RunningApi.SECRET.apiKey("hoeing"));
        assertThat(credentials.path("password").asText())
                .isEqualTo(RunningApi.SECRET.device("hoeing", id).password());
        assertThat(credentials.path("generation").asInt()).isZero();
        running.refused("GET", "/api/devices/urn:own:1/credentials", null, 404, "no-credentials");
        JsonNode real = running.get("/api/missions/hoeing/credentials");
        assertThat(real.findValuesAsText("device")).containsExactly("robot-1");
        assertThat(real.at("/0/measures").asText())
                .isEqualTo("/" + RunningApi.SECRET.apiKey("hoeing") + "/robot-1/attrs");
        assertThat(client.send("GET", "/api/devices/robot-1/credentials/qr", null)
                        .body())
                .asString()
                .startsWith("<svg");
        for (String path : List.of("/api/missions/hoeing/credentials", "/api/devices/robot-1/credentials")) {
            assertThat(client.send("GET", path, null, "Accept", "text/csv").body())
                    .asString()
                    .startsWith("device,deviceId,host,")
                    .contains("\r\nrobot-1,robot-1,")
                    .hasLineCount(2);
            assertThat(running.client()
                            .send("GET", path, null, "Accept", "application/json, */*")
                            .body())
                    .asString()
                    .contains("{\"device\":\"robot-1\"");
        }
        running.refused("GET", "/api/missions/nosuch/credentials", null, 404, "unknown-mission");

        JsonNode rotated = client.ask("POST", "/api/devices/" + id + "/credentials", null);
        assertThat(rotated.path("password").asText())
                .isEqualTo(RunningApi.SECRET.device("hoeing", id, 1).password());
        assertThat(running.get("/api/devices/" + id + "/credentials")).isEqualTo(rotated);
        assertThat(running.get("/api/devices/" + id).path("generation").asInt()).isEqualTo(1);
        assertThat(running.get("/api/missions/hoeing").at("/status/devices").asInt())
                .isEqualTo(4);
        running.refused("POST", "/api/devices/urn:own:1/credentials", null, 404, "no-credentials");
        running.refused("POST", "/api/devices/nosuch/credentials", null, 404, "unknown-device");

        assertThat(client.status("POST", "/api/devices/" + id + "/commands", "{\"command\":\"restart\",\"value\":7}"))
                .isEqualTo(202);
        assertThat(running.broker().last())
                .contains("Thermometer%3Ahoeing-1")
                .endsWith("{\"restart\":{\"type\":\"command\",\"value\":7}}");
        client.send("POST", "/api/devices/robot-1/commands", "{\"command\":\"Stop\"}");
        assertThat(running.broker().last())
                .contains("robot-1/attrs?options=forcedUpdate {\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"}");
        client.send("POST", "/api/devices/" + id + "/commands", "{\"command\":\"on\",\"type\":\"ROBOT\"}");
        assertThat(running.broker().last()).contains("hoeing-1/attrs?type=Thermometer {\"on\":");
        for (String own : new String[] {"urn:own:1", "urn:on:no-mission"}) {
            assertThat(client.status(
                            "POST", "/api/devices/" + own + "/commands", "{\"command\":\"Stop\",\"type\":\"ROBOT\"}"))
                    .as(own)
                    .isEqualTo(202);
            assertThat(running.broker().last())
                    .contains(own.replace(":", "%3A")
                            + "/attrs?options=forcedUpdate {\"cmd\":{\"type\":\"String\",\"value\":\"Stop\"}");
        }
        for (int[] status : new int[][] {{400, 400}, {404, 404}, {409, 409}, {422, 422}, {403, 502}, {500, 502}}) {
            running.broker().refuse(status[0]);
            running.refused(
                    "POST", "/api/devices/" + id + "/commands", "{\"command\":\"on\"}", status[1], "context-broker");
        }
        running.broker().refuse(204);
        running.refused(
                "POST", "/api/devices/robot-1/commands", "{\"command\":\"Stop\",\"value\":1}", 400, "wrong-member");
        running.refused("POST", "/api/devices/" + id + "/commands", "{\"command\":true}", 400, "wrong-member");
        running.refused("POST", "/api/devices/" + id + "/commands", "{\"value\":1}", 400, "missing-member");
        running.refused("POST", "/api/devices/" + id + "/commands", "{\"command\":\"a b\"}", 400, "wrong-member");
        running.refused("POST", "/api/devices/urn:own:1/commands", "{\"command\":\"on\"}", 400, "missing-member");
        running.refused("GET", "/api/devices/nosuch", null, 404, "unknown-device");
        running.refused("POST", "/api/devices/nosuch/commands", "{\"command\":\"on\"}", 404, "unknown-device");

        await().untilAsserted(() -> assertThat(running.get("/api/audit?limit=1000"))
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

    @Test
    void retainsTemplatesByVersion() throws Exception {
        String template = "{\"template\":\"t\",\"devices\":[{\"type\":\"Thermometer\",\"count\":3}]}";
        client.send("POST", "/api/templates", template);
        JsonNode second = client.ask("POST", "/api/templates", template);
        assertThat(second.path("version").asInt()).isEqualTo(2);
        assertThat(running.get("/api/templates/t").path("version").asInt()).isEqualTo(2);
        assertThat(running.get("/api/templates/t@1").path("version").asInt()).isEqualTo(1);
        assertThat(running.get("/api/templates").findValuesAsText("template")).contains("t", "thesis-demo");

        String exported = running.get("/api/templates/thesis-demo").toString();
        assertThat(client.ask("POST", "/api/templates", exported)
                        .path("version")
                        .asInt())
                .isEqualTo(2);
        assertThat(client.status("DELETE", "/api/templates/t@2", null)).isEqualTo(200);
        assertThat(running.get("/api/templates/t").path("version").asInt()).isEqualTo(1);
        assertThat(client.status("DELETE", "/api/templates/t", null)).isEqualTo(200);
        running.refused("GET", "/api/templates/t", null, 404, "unknown-template");
        running.refused("DELETE", "/api/templates/t@1", null, 404, "unknown-template");
        running.refused("DELETE", "/api/templates/t@x", null, 404, "unknown-template");
    }

    @Test
    void steersReplays() throws Exception {
        JsonNode made = client.ask("POST", "/api/replays", "{\"mission\":\"hoeing\",\"speed\":\"max\"}");
        String replay = "/api/replays/" + made.path("replay").asText();
        assertThat(running.get(replay).path("wanted").asText()).isEqualTo("running");
        assertThat(client.ask("POST", replay + "/pause", null).path("status").asText())
                .isEqualTo("paused");
        assertThat(client.status("POST", replay + "/step", "{\"count\":3}")).isEqualTo(200);
        assertThat(client.status("POST", replay + "/seek", "{\"to\":1700000000000}"))
                .isEqualTo(200);
        assertThat(client.status("POST", replay + "/speed", "{\"speed\":2}")).isEqualTo(200);
        assertThat(client.status("POST", replay + "/resume", null)).isEqualTo(200);
        assertThat(running.get("/api/replays").findValuesAsText("replay"))
                .contains(made.path("replay").asText());
        running.refused("POST", replay + "/step", "{}", 409, "wrong-state");
        running.refused("POST", replay + "/dance", null, 404, "not-found");
        assertThat(client.status("DELETE", replay, null)).isEqualTo(200);
        running.refused("GET", "/api/replays/hoeing.00000000", null, 404, "unknown-replay");
    }

    @Test
    void startsAndSteersReplaysOfOneMission() throws Exception {
        HttpResponse<byte[]> made = client.send("POST", "/api/replays", """
                {"mission": "ridging", "topic": "data.show.replay.0000cafe", "from": 0, "to": 9000, "range": {"from": 1000, "to": 2000},
                 "maxGap": "PT5S", "stamps": "now", "startAt": 1700000000000, "analytics": ["presence"], "source": {"file": "a.jsonl"}}
                """);
        assertThat(made.statusCode()).as(new String(made.body())).isEqualTo(201);
        String replay = "/api/replays/ridging.0000cafe";
        assertThat(made.headers().firstValue("Location")).contains(running.api().uri() + replay);
        assertThat(running.get(replay).at("/range/to").asLong()).isEqualTo(2000);
        assertThat(running.get(replay).path("stamps").asText()).isEqualTo("now");
        assertThat(running.get(replay).at("/source/file").asText()).isEqualTo("a.jsonl");

        assertThat(client.status("POST", replay + "/loop", "{\"from\":3000,\"to\":4000}"))
                .isEqualTo(200);
        assertThat(running.get(replay).at("/range/to").asLong()).isEqualTo(4000);
        assertThat(client.status("POST", replay + "/loop", null)).isEqualTo(200);
        assertThat(running.get(replay).has("range")).isFalse();
        running.refused(
                "POST",
                "/api/replays",
                "{\"mission\":\"ridging\",\"topic\":\"data.show.replay.0000cafe\"}",
                409,
                "replay-exists");
        assertThat(client.status("GET", replay + "/events", null)).isEqualTo(200);
        assertThat(client.status("GET", "/api/replays/events", null)).isEqualTo(200);
        running.refused("GET", "/api/replays/ridging.00000000/events", null, 404, "unknown-replay");
        assertThat(running.get("/api/recordings")).isEmpty();
    }

    @Test
    void hasNoMarkersWithoutMongoDb() throws Exception {
        String markers = "/api/missions/weeding/markers";
        running.refused("GET", markers, null, 501, "no-mongodb");
        running.refused("POST", markers, "{\"time\":5,\"note\":\"n\"}", 501, "no-mongodb");
        running.refused("DELETE", markers + "/m", null, 501, "no-mongodb");
    }

    @Test
    void startsAndSteersReplaysOfSeveralMissionsByOneClock() throws Exception {
        HttpResponse<byte[]> made = client.send(
                "POST", "/api/replays", "{\"missions\":[\"sowing\",\"rolling\"],\"from\":1000,\"to\":900000}");
        assertThat(made.statusCode()).as(new String(made.body())).isEqualTo(201);
        String group = "/api/replays/groups/" + client.json(made).path("group").asText();
        assertThat(made.headers().firstValue("Location")).contains(running.api().uri() + group);
        assertThat(running.get(group).findValuesAsText("mission")).containsExactly("rolling", "sowing");

        assertThat(client.status("POST", group + "/pause", null)).isEqualTo(200);
        assertThat(client.status("POST", group + "/seek", "{\"to\":5000}")).isEqualTo(200);
        assertThat(running.get(group).get(0).at("/clock/shows").asLong()).isEqualTo(5000);
        running.refused("POST", group + "/step", "{}", 409, "wrong-state");
        running.refused("GET", "/api/replays/groups/0a1b2c3d", null, 404, "unknown-replay");
        assertThat(client.status("DELETE", group, null)).isEqualTo(200);
        assertThat(running.get(group).findValuesAsText("wanted")).containsExactly("stopped", "stopped");
    }

    @Test
    void givesTheSameKeyOneEffectAndTheSameAnswer() throws Exception {
        String body = "{\"domain\":\"once\"}";
        HttpResponse<byte[]> first = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        HttpResponse<byte[]> again = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        assertThat(first.statusCode()).isEqualTo(201);
        assertThat(again.statusCode()).isEqualTo(201);
        assertThat(again.body()).isEqualTo(first.body());

        try (RestApi other = RestApi.start(running.settings(), RestSettings.on(0), new Readiness(Clock.systemUTC()))) {
            ApiClient there = new ApiClient(other.uri(), null);
            await().until(() -> there.status("GET", "/ready", null) == 200);
            assertThat(there.send("POST", "/api/domains", body, "Idempotency-Key", "key-1")
                            .body())
                    .isEqualTo(first.body());
            assertThat(there.status("POST", "/api/domains", body)).isEqualTo(409);
            there.send("POST", "/api/missions/self/start", "{\"domain\":\"once\",\"devices\":[\"urn:own:2\"]}");
            String commands = "/api/devices/urn:own:2/commands";
            assertThat(there.error("POST", commands, "{\"command\":\"on\",\"type\":\"Pump\"}"))
                    .isEqualTo("501 no-context-broker");
            assertThat(there.error("GET", "/api/devices/urn:own:2/credentials", null))
                    .isEqualTo("404 no-credentials");
            assertThatThrownBy(() -> RestApi.start(
                            running.settings(),
                            RestSettings.on(other.uri().getPort()),
                            new Readiness(Clock.systemUTC())))
                    .isInstanceOf(java.io.IOException.class)
                    .hasMessageContaining("Choose another port");
        }
    }

    @Test
    void takesALongDeviceListInSeveralRequests() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"listed\"}");
        client.send("POST", "/api/missions", "{\"mission\":\"long\",\"domain\":\"listed\"}");
        for (int part = 0; part < 2; part++) {
            String ids = IntStream.range(part * 5000, part * 5000 + 5000)
                    .mapToObj(i ->
                            "\"urn:ngsi-ld:Sensor:of-a-farm-with-long-names:%04d-%s\"".formatted(i, "x".repeat(40)))
                    .collect(Collectors.joining(","));
            assertThat(client.status("POST", "/api/missions/long/devices", "{\"devices\":[" + ids + "]}"))
                    .isEqualTo(200);
        }
        assertThat(running.get("/api/missions/long").path("devices")).hasSize(10_000);
        running.refused("POST", "/api/missions/long/devices", "{\"devices\":[\"urn:more\"]}", 400, "wrong-member");
        assertThat(client.status("POST", "/api/missions/long/start", "{}")).isEqualTo(200);
        await().until(() -> running.get("/api/devices?mission=long").size() == 10_000);
        running.refused("POST", "/api/missions/long/devices", "{\"devices\":[\"urn:more\"]}", 409, "mission-running");
    }

    @Test
    void importsFieldsAndRejectsThoseThatAreNone() throws Exception {
        String square = "[[[10,50],[10.001,50],[10.001,50.001],[10,50.001],[10,50]]]";
        String file = """
                {"type":"FeatureCollection","features":[
                  {"type":"Feature","id":"a","geometry":{"type":"Polygon","coordinates":%s},"properties":{"name":"Home"}},
                  {"type":"Feature","id":"b","geometry":{"type":"Point","coordinates":[10,50]},"properties":{}}]}
                """.formatted(square);

        JsonNode first = client.ask("POST", "/api/fields?domain=north", file);
        JsonNode again = client.ask("POST", "/api/fields?domain=north", file);

        assertThat(first.path("imported").asInt()).isEqualTo(1);
        assertThat(first.at("/fields/0/change").asText()).isEqualTo("added");
        assertThat(first.at("/refused/0/id").asText()).isEqualTo("b");
        assertThat(first.at("/refused/0/reason").asText()).contains("Point");
        assertThat(again.path("imported").asInt()).isZero();
        assertThat(again.path("unchanged").asInt()).isEqualTo(1);
        JsonNode fields = running.get("/api/fields");
        assertThat(fields.path("type").asText()).isEqualTo("FeatureCollection");
        assertThat(fields.path("features")).hasSize(1);
        JsonNode home = fields.at("/features/0");
        assertThat(home.path("id").asText()).isEqualTo("a");
        assertThat(home.at("/properties/name").asText()).isEqualTo("Home");
        assertThat(home.at("/geometry/coordinates/0/1/0").asDouble()).isEqualTo(10.001);
        assertThat(running.get("/api/fields?domain=north").path("features")).hasSize(1);
        assertThat(running.get("/api/fields?domain=south").path("features")).isEmpty();
        client.send("POST", "/api/fields?domain=north", file.replace("Home", "Behind the barn"));
        assertThat(running.get("/api/fields").path("features"))
                .singleElement()
                .satisfies(
                        now -> assertThat(now.at("/properties/name").asText()).isEqualTo("Behind the barn"));

        String bow = file.replace(square, "[[[10,50],[10.002,50.002],[10.002,50],[10,50.002],[10,50]]]");
        assertThat(client.ask("POST", "/api/fields?domain=north", bow).at("/fields/0/mended"))
                .anySatisfy(note -> assertThat(note.asText()).contains("Self-intersection"));
        assertThat(running.get("/api/fields").at("/features/0/geometry/type").asText())
                .isEqualTo("MultiPolygon");
        assertThat(client.ask("POST", "/api/fields?crs=EPSG:1", file)
                        .path("reason")
                        .asText())
                .contains("specify it with 'crs'");
        assertThat(client.ask("POST", "/api/fields?name-property=nosuch", file)
                        .path("reason")
                        .asText())
                .contains("'name-property' nosuch: no feature of the file has this attribute");

        JsonNode renamed = client.ask("PATCH", "/api/fields/a", "{\"name\":\"Hill\"}");
        assertThat(renamed.path("status").asText() + " " + renamed.path("name").asText())
                .isEqualTo("changed Hill");
        assertThat(running.get("/api/fields").at("/features/0/properties/name").asText())
                .isEqualTo("Hill");
        for (String body : new String[] {
            "{}", "{\"name\":\" \"}", "{\"nmae\":\"x\"}",
            "{\"name\":\"x\",\"validTo\":1}", "{\"validTo\":\"soon\"}", "{\"validTo\":null}",
            "{\"name\":7}"
        }) {
            running.refused("PATCH", "/api/fields/a", body, 400, "wrong-member");
        }
        running.refused("PATCH", "/api/fields/z", "{\"name\":\"x\"}", 404, "unknown-field");
        running.refused("DELETE", "/api/fields/z", null, 404, "unknown-field");
        running.refused("PATCH", "/api/fields/a", "{\"validTo\":1}", 409, "wrong-state");
        String now = Instant.now().toString();
        assertThat(client.ask("PATCH", "/api/fields/a", "{\"validTo\":\"%s\"}".formatted(now))
                        .path("status")
                        .asText())
                .isEqualTo("ended");
        assertThat(running.get("/api/fields").path("features")).isEmpty();
        assertThat(client.ask("DELETE", "/api/fields/a", null).path("versions").asInt())
                .isEqualTo(4);

        running.refused("POST", "/api/fields", "{\"type\":\"Feature", 400, "unusable-file");
        running.refused("POST", "/api/fields?domain=a.b", file, 400, "wrong-member");
        running.refused("POST", "/api/fields", " ".repeat(FieldsResource.LARGEST + 1), 413, "too-large");
        await().untilAsserted(
                        () -> assertThat(running.get("/api/audit?limit=1000").findValuesAsText("command"))
                                .contains("import-fields", "rename-field", "end-field", "delete-field"));
    }

    @Test
    void reportsWhatWasCommandedToAMission() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"audited\"}");
        for (String mission : new String[] {"one", "two"}) {
            client.send("POST", "/api/missions", """
                    {"mission":"%s","domain":"audited","devices":["urn:%s"]}""".formatted(mission, mission));
        }
        await().until(() -> running.get("/api/audit?mission=two").size() == 1);
        assertThat(running.get("/api/audit?mission=two").at("/0/about/mission").asText())
                .isEqualTo("two");
        assertThat(running.get("/api/audit?device=urn:nobody")).isEmpty();
    }

    @Test
    void reportsItself() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"counted\"}");
        assertThat(running.get("/openapi.json"))
                .isEqualTo(NgsiJson.read(NgsiJson.write(OpenApiDocument.read().json())));
        assertThat(running.get("/api/alarms?state=open")).isEmpty();
        assertThat(running.get("/api/audit").size()).isLessThanOrEqualTo(100);
        assertThat(new String(client.send("GET", "/metrics", null).body()))
                .contains(
                        "furrow_control_view_complete 1",
                        "path=\"/api/alarms\"",
                        "furrow_control_answers_total{manager=\"service.domainmanager\",status=\"created\"}");
    }

    /** The alarms' manager does not run here. */
    @Test
    void reportsThatNobodyAnsweredAndHowToRetry() throws Exception {
        Readiness readiness = new Readiness(Clock.systemUTC());
        readiness.require(() -> new ComponentStatus("managers", ComponentStatus.State.DOWN, null, "REBALANCING"));
        try (RestApi other =
                RestApi.start(running.settings(), RestSettings.on(0).withTimeout(Duration.ofMillis(300)), readiness)) {
            ApiClient there = new ApiClient(other.uri(), null);
            await().until(other::isReady);
            assertThat(there.status("GET", "/health", null)).isEqualTo(200);
            assertThat(there.status("GET", "/ready", null)).isEqualTo(503);
            for (String path : new String[] {"/api/alarms/a-1/mute", "/api/alarms/mute"}) {
                HttpResponse<byte[]> answer = there.send("POST", path, "{}", "Idempotency-Key", "again");
                assertThat(client.error(answer)).isEqualTo("503 not-answered");
                assertThat(answer.headers().firstValue("Retry-After")).contains("1");
                assertThat(there.json(answer).path("reason").asText()).contains("Idempotency-Key: again");
            }
        }
    }
}
