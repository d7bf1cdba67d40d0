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
import io.furrow.model.ngsi.NgsiJson;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class RestApiIT implements DeviceRoutes, FieldRoutes, ReplayRoutes {
    private static final String DEVICES =
            "[{\"type\":\"Thermometer\",\"count\":2,\"simulated\":true,\"period\":\"PT0.5S\"},{\"type\":\"Robot\",\"id\":\"robot-2\"},\"urn:own:3\"]";

    private RunningApi running;
    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        client = running.client();
    }

    /** Every route was requested, and every answer matched its description. */
    @AfterAll
    void stop() throws Exception {
        running.close();
        assertThat(ApiClient.REQUESTED).containsAll(OpenApiDocument.read().operations());
    }

    @Override
    public RunningApi running() {
        return running;
    }

    @Test
    void answersHeadWithTheLengthOfTheAnswerToGet() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"measured\"}");
        for (String path : List.of("/openapi.json", "/api/v1/domains/measured", "/api/v1/domains?limit=1")) {
            HttpResponse<byte[]> head = client.send("HEAD", path, null, false);
            assertThat(head.headers().firstValueAsLong("Content-Length"))
                    .as(path)
                    .hasValue(client.send("GET", path, null).body().length);
        }
    }

    /** Further cases are in separate tests. */
    @Test
    void describesTheCallerAndMissingResources() throws Exception {
        assertThat(client.status("GET", "/api/me", null)).isEqualTo(200);
        assertThat(client.status("HEAD", "/api/replays/events", null)).isEqualTo(200);
        for (String kind : new String[] {"missions", "devices", "alarms", "replays"}) {
            assertThat(client.status("HEAD", "/api/events/" + kind, null)).isEqualTo(200);
            assertThat(client.status("GET", "/api/events/" + kind, null)).isEqualTo(200);
        }
        assertThat(client.status("HEAD", "/api/replays/none.1/events", null))
                .isEqualTo(200); // HEAD does not look the replay up
        running.rejects("GET", "/api/alarms/none", null, 404, "unknown-alarm");
        running.rejects("GET", "/api/recordings/none/timeline", null, 501, "no-mongodb");
        running.rejects("GET", "/api/devices/none/history?attribute=speed", null, 501, "no-mongodb");
        running.rejects("DELETE", "/api/recordings/none", null, 501, "no-mongodb");
        running.rejects("GET", "/api/recordings/none/events", null, 501, "no-mongodb");
        running.rejects("POST", "/api/recordings/none/events", "{}", 501, "no-mongodb");
        assertThat(client.get("/api/dead-letters")).isEmpty();
        running.rejects("GET", "/api/dead-letters/none.dead/0/0", null, 404, "unknown-dead-letter");
        running.rejects("POST", "/api/dead-letters/redrive", "{\"topic\":\"none.dead\"}", 404, "unknown-topic");
        assertThat(client.get("/api/topics").findValuesAsText("topic")).contains("service.missions");
        assertThat(client.status("GET", "/api/topics/service.missions/records", null))
                .isEqualTo(200);
        running.rejects("GET", "/api/topics/service.missions/records/99/0", null, 404, "unknown-record");
    }

    @Test
    void handlesTheLifeCycleOfADomain() throws Exception {
        HttpResponse<byte[]> created = client.send("POST", "/api/domains", "{\"domain\":\"north\",\"name\":\"North\"}");
        assertThat(created.statusCode()).isEqualTo(201);
        assertThat(created.headers().firstValue("Location")).contains("domains/north");
        assertThat(running.get("/api/domains/north").path("name").asText()).isEqualTo("North");
        assertThat(client.status("PATCH", "/api/domains/north", "{\"description\":\"wet\"}"))
                .isEqualTo(200);
        assertThat(running.get("/api/domains").findValuesAsText("description")).contains("wet");
        String patch = "{\"name\":null}";
        assertThat(client.status("PATCH", "/api/domains/north", patch, "Content-Type", "application/merge-patch+json"))
                .isEqualTo(200);
        assertThat(running.get("/api/domains/north").has("name")).isFalse();
        assertThat(running.get("/api/domains/north").path("description").asText())
                .isEqualTo("wet");

        running.rejects("POST", "/api/domains", "{\"domain\":\"north\"}", 409, "domain-exists");
        assertThat(client.status("DELETE", "/api/domains/north", null)).isEqualTo(200);
        running.rejects("GET", "/api/domains/north", null, 404, "unknown-domain");
        running.rejects("DELETE", "/api/domains/north?force=true", null, 404, "unknown-domain");
        running.rejects("PATCH", "/api/domains/north", "{}", 404, "unknown-domain");
    }

    @Test
    void changesOnlyTheSequenceThatARequestHasRead() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"matched\"}");
        String read = client.send("GET", "/api/domains/matched", null)
                .headers()
                .firstValue("ETag")
                .orElseThrow();
        String path = "/api/domains/matched";
        assertThat(client.status("PATCH", path, "{\"name\":\"a\"}", "If-Match", read))
                .isEqualTo(200);

        HttpResponse<byte[]> outdated = client.send("PATCH", path, "{\"name\":\"b\"}", "If-Match", read);
        assertThat(outdated.statusCode()).isEqualTo(412);
        assertThat(client.json(outdated).path("error").asText()).isEqualTo("outdated");
        assertThat(client.status("DELETE", path, null, "If-Match", read)).isEqualTo(412);
        assertThat(running.get(path).path("name").asText()).isEqualTo("a");
        for (String wrong : new String[] {"W/x", "*"}) {
            assertThat(client.status("PATCH", path, "{\"name\":\"b\"}", "If-Match", wrong))
                    .isEqualTo(400);
        }
        assertThat(client.status("POST", "/api/domains", "{\"domain\":\"x\"}", "If-Match", read))
                .isEqualTo(400);
    }

    /** Any other method would not be that of which role and size of the body were checked. */
    @Test
    void takesAPostForAPatchOnly() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"overridden\"}");
        String path = "/api/domains/overridden";
        String override = "X-HTTP-Method-Override";

        assertThat(client.send("POST", path, "{\"name\":\"a\"}", false, override, "PATCH")
                        .statusCode())
                .isEqualTo(200);
        assertThat(running.get(path).path("name").asText()).isEqualTo("a");
        for (String method : new String[] {"GET", "DELETE", "POST", "patch"}) {
            assertThat(client.send("POST", path, "{}", false, override, method).statusCode())
                    .isEqualTo(400);
        }
        assertThat(client.status("DELETE", path, null, override, "PATCH")).isEqualTo(400);
        assertThat(client.status("DELETE", path, null)).isEqualTo(200);
    }

    @Test
    void answersListsInPages() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"paged\"}");
        client.send("POST", "/api/domains", "{\"domain\":\"other\"}");
        client.send("POST", "/api/missions", "{\"mission\":\"p0\",\"domain\":\"other\"}");
        for (String mission : List.of("p1", "p2", "p3")) {
            client.send("POST", "/api/missions", "{\"mission\":\"%s\",\"domain\":\"paged\"}".formatted(mission));
        }

        HttpResponse<byte[]> first = client.send("GET", "/api/v1/missions?domain=paged&limit=2", null);
        assertThat(missionsOf(first)).containsExactly("p1", "p2");
        assertThat(first.headers().allValues("Link")).containsExactly("<?domain=paged&limit=2&page=2>; rel=\"next\"");
        HttpResponse<byte[]> second = client.send("GET", "/api/missions?domain=paged&limit=2&page=2", null);
        assertThat(missionsOf(second)).containsExactly("p3");
        assertThat(second.headers().allValues("Link")).containsExactly("<?domain=paged&limit=2&page=1>; rel=\"prev\"");
        assertThat(running.get("/api/missions?domain=paged&limit=1000&page=1000000"))
                .isEmpty();
        running.rejects("GET", "/api/missions?limit=0", null, 400, "wrong-member");
        running.rejects("GET", "/api/missions?page=1&page=2", null, 400, "wrong-member");
    }

    @Test
    void listsTheCatalog() throws Exception {
        for (String mission : List.of("c1", "c2", "c3")) {
            running.write("data.catalog", "|north|%s|T".formatted(mission), """
                    {"domain":"%s","mission":"%s","type":"T","events":3,"first":"2023-11-14T22:13:20Z"}""".formatted(
                            mission.equals("c1") ? "south" : "north", mission)
                    .getBytes(UTF_8));
        }
        running.write("data.catalog", "|north|c3|T", null);
        running.write("data.catalog", "other", "not an entry".getBytes(UTF_8));
        running.write("data.catalog", "another", "{\"mission\":5,\"type\":\"T\"}".getBytes(UTF_8));
        await().until(() -> running.get("/api/catalog?mission=c3").isEmpty());

        assertThat(missionsOf(client.send("GET", "/api/catalog", null))).containsExactlyInAnyOrder("c1", "c2");
        assertThat(missionsOf(client.send("GET", "/api/catalog?domain=north", null)))
                .containsExactly("c2");
        assertThat(missionsOf(client.send("GET", "/api/v1/catalog?limit=1&page=2", null)))
                .hasSize(1);
    }

    /** Each answer is as described: with the times of /api it would not be. */
    @Test
    void answersTimesOfVersion1InIso8601() throws Exception {
        client.send("POST", "/api/v1/domains", "{\"domain\":\"timed\"}");
        String start = "2999-01-01T00:00:00Z";
        JsonNode scheduled = client.ask(
                "POST",
                "/api/v1/missions/timed/start",
                "{\"domain\":\"timed\",\"devices\":[\"urn:timed\"],\"start\":\"%s\"}".formatted(start));
        assertThat(scheduled.path("start").asText()).isEqualTo(start);
        JsonNode mission = client.get("/api/v1/missions/timed");
        assertThat(mission.path("start").asText()).isEqualTo(start);
        assertThat(Instant.parse(mission.at("/status/since").asText()).toEpochMilli())
                .isEqualTo(
                        running.get("/api/missions/timed").at("/status/since").asLong());
        String replay = client.ask("POST", "/api/v1/replays", """
                        {"mission":"timed","from":"%s","to":"3000-01-01T00:00:00Z"}""".formatted(start))
                .path("replay")
                .asText();
        assertThat(client.get("/api/v1/replays/" + replay).path("from").asText())
                .isEqualTo(start);
        for (String list : List.of("domains", "missions", "devices", "replays", "alarms", "recordings", "audit")) {
            assertThat(client.status("GET", "/api/v1/" + list, null)).as(list).isEqualTo(200);
        }
        running.rejects("GET", "/api/v1/missions/nosuch", null, 404, "unknown-mission");
    }

    private List<String> missionsOf(HttpResponse<byte[]> list) throws Exception {
        return client.json(list)
                .valueStream()
                .map(mission -> mission.path("mission").asText())
                .toList();
    }

    private String statusOf(String command) throws Exception {
        return client.json(client.send("POST", command, null)).path("status").asText();
    }

    @Test
    void handlesTheLifeCycleOfAMission() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"west\"}");
        JsonNode later = client.ask(
                "POST", "/api/missions/later/start", "{\"domain\":\"west\",\"start\":\"2999-01-01T00:00:00Z\"}");
        assertThat(later.path("status").asText()).isEqualTo("scheduled");
        String mission = "{\"mission\":\"tilling\",\"domain\":\"west\",\"devices\":%s}".formatted(DEVICES);
        assertThat(client.status("POST", "/api/missions", mission)).isEqualTo(201);
        assertThat(running.get("/api/missions/tilling").at("/status/state").asText())
                .isEqualTo("created");
        assertThat(statusOf("/api/missions/tilling/start")).isEqualTo("started");
        JsonNode started = running.get("/api/missions/tilling?wait=running&wait=starting");
        assertThat(started.at("/status/state").asText()).isEqualTo("starting");
        assertThat(started.at("/status/devices").asInt()).isEqualTo(4);
        assertThat(started.path("devices")).hasSize(3);
        assertThat(running.get("/api/missions/tilling?wait=running&timeout=1")
                        .at("/status/state")
                        .asText())
                .isEqualTo("starting");
        running.rejects("GET", "/api/missions/tilling?wait=up", null, 400, "wrong-member");
        assertThat(running.get("/api/missions?domain=west").findValuesAsText("mission"))
                .contains("tilling");
        assertThat(running.get("/api/missions?domain=nosuch")).isEmpty();

        running.rejects("POST", "/api/missions/tilling/start", "{}", 409, "mission-running");
        running.rejects("DELETE", "/api/domains/west", null, 409, "missions-running");
        assertThat(statusOf("/api/missions/tilling/stop")).isEqualTo("stopped");
        running.rejects("DELETE", "/api/missions/tilling", null, 409, "mission-running");
        running.rejects("GET", "/api/missions/nosuch", null, 404, "unknown-mission");
        running.rejects("POST", "/api/missions/nosuch/stop", null, 404, "unknown-mission");
        running.rejects("DELETE", "/api/missions/nosuch", null, 404, "unknown-mission");
        running.rejects("POST", "/api/missions", "{\"mission\":\"a.b\",\"domain\":\"west\"}", 400, "illegal-name");
    }

    @Test
    void storesTemplatesByVersion() throws Exception {
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
        running.rejects("GET", "/api/templates/t", null, 404, "unknown-template");
        running.rejects("DELETE", "/api/templates/t@1", null, 404, "unknown-template");
        running.rejects("DELETE", "/api/templates/t@x", null, 404, "unknown-template");
    }

    @Test
    void hasNoMarkersWithoutMongoDb() throws Exception {
        String markers = "/api/missions/weeding/markers";
        running.rejects("GET", markers, null, 501, "no-mongodb");
        running.rejects("POST", markers, "{\"time\":5,\"note\":\"n\"}", 501, "no-mongodb");
        running.rejects("DELETE", markers + "/m", null, 501, "no-mongodb");
    }

    @Test
    void executesRequestsWithTheSameKeyOnce() throws Exception {
        String body = "{\"domain\":\"once\"}";
        HttpResponse<byte[]> first = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        HttpResponse<byte[]> repeated = client.send("POST", "/api/domains", body, "Idempotency-Key", "key-1");
        assertThat(first.statusCode()).isEqualTo(201);
        assertThat(repeated.statusCode()).isEqualTo(201);
        assertThat(repeated.body()).isEqualTo(first.body());

        try (RestApi other = RestApi.start(running.settings(), RestSettings.on(0), new Readiness(Clock.systemUTC()))) {
            ApiClient otherClient = new ApiClient(other.uri(), null);
            await().until(() -> otherClient.status("GET", "/ready", null) == 200);
            assertThat(otherClient
                            .send("POST", "/api/domains", body, "Idempotency-Key", "key-1")
                            .body())
                    .isEqualTo(first.body());
            assertThat(otherClient.status("POST", "/api/domains", body)).isEqualTo(409);
            otherClient.send("POST", "/api/missions/self/start", "{\"domain\":\"once\",\"devices\":[\"urn:own:2\"]}");
            String commands = "/api/devices/urn:own:2/commands";
            assertThat(otherClient.error("POST", commands, "{\"command\":\"on\",\"type\":\"Pump\"}"))
                    .isEqualTo("501 no-context-broker");
            assertThat(otherClient.error("GET", "/api/devices/urn:own:2/credentials", null))
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
    void acceptsALongDeviceListInSeveralRequests() throws Exception {
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
        running.rejects("POST", "/api/missions/long/devices", "{\"devices\":[\"urn:more\"]}", 400, "wrong-member");
        assertThat(client.status("POST", "/api/missions/long/start", "{}")).isEqualTo(200);
        await().until(() -> running.get("/api/devices?mission=long").size() == 10_000);
        running.rejects("POST", "/api/missions/long/devices", "{\"devices\":[\"urn:more\"]}", 409, "mission-running");
    }

    @Test
    void filtersTheAuditByMissionAndDevice() throws Exception {
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

    /** The tag of a compressed answer has a suffix, which no client knows to remove. */
    @Test
    void compressesAnswersButNoEvents() throws Exception {
        String path = "/api/domains/compressed";
        client.send(
                "POST",
                "/api/domains",
                "{\"domain\":\"compressed\",\"description\":\"%s\"}".formatted("wet ".repeat(500)));

        HttpResponse<byte[]> answer = client.send("GET", path, null, false, "Accept-Encoding", "gzip");
        assertThat(answer.headers().firstValue("Content-Encoding")).contains("gzip");
        assertThat(answer.body()).hasSizeLessThan(1000);
        String tag = answer.headers().firstValue("ETag").orElseThrow();
        assertThat(client.status("PATCH", path, "{\"name\":\"a\"}", "If-Match", tag))
                .isEqualTo(200);
        assertThat(client.status("PATCH", path, "{\"name\":\"b\"}", "If-Match", tag))
                .isEqualTo(412);
        HttpResponse<byte[]> events = client.send("GET", "/api/events/missions", null, "Accept-Encoding", "gzip");
        assertThat(new String(events.body(), UTF_8)).startsWith(":");
    }

    @Test
    void describesItself() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"counted\"}");
        client.send("POST", "/api/domains?dryRun=true", "{\"domain\":\"not-counted\"}");
        assertThat(running.get("/openapi.json"))
                .isEqualTo(
                        NgsiJson.read(NgsiJson.write(OpenApiDocument.version1().json())));
        assertThat(running.get("/api/alarms?state=open")).isEmpty();
        assertThat(running.get("/api/audit").size()).isLessThanOrEqualTo(100);
        assertThat(new String(client.send("GET", "/metrics", null).body()))
                .contains(
                        "furrow_control_view_complete 1",
                        "path=\"/api/alarms\"",
                        "furrow_control_answers_total{manager=\"service.domainmanager\",status=\"created\"}",
                        "furrow_control_answers_total{manager=\"service.domainmanager\",status=\"dry-run\"}");
    }

    /** The manager of alarms is not running here. */
    @Test
    void reportsAMissingAnswerAndHowToRetry() throws Exception {
        Readiness readiness = new Readiness(Clock.systemUTC());
        readiness.require(() -> new ComponentStatus("managers", ComponentStatus.State.DOWN, null, "REBALANCING"));
        try (RestApi other =
                RestApi.start(running.settings(), RestSettings.on(0).withTimeout(Duration.ofMillis(300)), readiness)) {
            ApiClient otherClient = new ApiClient(other.uri(), null);
            await().until(other::isReady);
            assertThat(otherClient.status("GET", "/health", null)).isEqualTo(200);
            assertThat(otherClient.status("GET", "/ready", null)).isEqualTo(503);
            for (String path : new String[] {"/api/alarms/a-1/mute", "/api/alarms/mute", "/api/alarms/unmute"}) {
                HttpResponse<byte[]> answer = otherClient.send("POST", path, "{}", "Idempotency-Key", "again");
                assertThat(client.error(answer)).isEqualTo("503 not-answered");
                assertThat(answer.headers().firstValue("Retry-After")).contains("1");
                assertThat(otherClient.json(answer).path("reason").asText()).contains("Idempotency-Key: again");
            }
        }
    }
}
