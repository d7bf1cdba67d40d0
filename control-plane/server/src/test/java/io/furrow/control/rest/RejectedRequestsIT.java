package io.furrow.control.rest;

import java.net.http.HttpResponse;
import java.nio.file.Path;
import java.time.Clock;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.kafka.Readiness;
import io.furrow.model.control.Limits;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class RejectedRequestsIT {
    @AutoClose
    private RunningApi running;

    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path directory) throws Exception {
        running = new RunningApi(directory);
        client = running.client();
    }

    /** Returning the answer of another request would report a change that was not made. */
    @Test
    void rejectsAReusedIdempotencyKey() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"keyed\"}");
        String start = "{\"domain\":\"keyed\"}";
        client.send("POST", "/api/missions/b/start", start);
        assertThat(client.status("POST", "/api/missions/a/start", start, "Idempotency-Key", "key-2"))
                .isEqualTo(200);

        assertThat(client.error("POST", "/api/missions/b/stop", null, "Idempotency-Key", "key-2"))
                .isEqualTo("422 request-id-reused");
        assertThat(client.error(
                        "POST", "/api/missions/a/start", "{\"domain\":\"nowhere\"}", "Idempotency-Key", "key-2"))
                .isEqualTo("422 request-id-reused");
        assertThat(running.get("/api/missions/b").at("/status/state").asText()).isEqualTo("running");
        assertThat(client.status("POST", "/api/missions/a/start", start, "Idempotency-Key", "key-2"))
                .isEqualTo(200);

        try (RestApi other = RestApi.start(running.settings(), RestSettings.on(0), new Readiness(Clock.systemUTC()))) {
            ApiClient there = new ApiClient(other.uri(), null);
            await().until(other::isReady);
            assertThat(there.error("POST", "/api/missions/b/stop", null, "Idempotency-Key", "key-2"))
                    .isEqualTo("422 request-id-reused");
        }
    }

    @Test
    void rejectsAnOversizedRequestAndContinues() throws Exception {
        String area = "{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[1,1],[0,0]]],\"note\":\"%s\"}";
        for (int bytes : new int[] {Limits.REQUEST_BYTES - 100, Limits.REQUEST_BYTES, 1_300_000}) {
            String body = "{\"domain\":\"large\",\"area\":%s}".formatted(area.formatted("x".repeat(bytes)));
            assertThat(client.error("POST", "/api/domains", body)).isEqualTo("413 too-large");
        }
        String body =
                "{\"domain\":\"large\",\"area\":%s}".formatted(area.formatted("x".repeat(Limits.REQUEST_BYTES - 400)));
        assertThat(client.status("POST", "/api/domains", body)).isEqualTo(201);
        assertThat(running.get("/api/domains/large").at("/area/note").asText()).hasSize(Limits.REQUEST_BYTES - 400);
        client.send("DELETE", "/api/domains/large", null);
    }

    /** A misspelled name would be ignored: the mission would have no devices, the list all missions. */
    @Test
    void rejectsUnknownMembersAndParametersAndChangesNothing() throws Exception {
        client.send("POST", "/api/domains", "{\"domain\":\"strict\",\"name\":\"Strict\"}");
        String mission = "{\"mission\":\"misspelled\",\"domain\":\"strict\",\"tmplate\":\"thesis-demo\"}";
        assertThat(client.error("POST", "/api/missions", mission)).isEqualTo("400 unknown-member");
        assertThat(client.error("PATCH", "/api/domains/strict", "{\"nmae\":\"x\"}"))
                .isEqualTo("400 unknown-member");
        assertThat(client.error("GET", "/api/missions?domian=strict", null)).isEqualTo("400 unknown-parameter");
        assertThat(client.error("DELETE", "/api/domains/strict?froce=true", null))
                .isEqualTo("400 unknown-parameter");

        assertThat(running.get("/api/missions?domain=strict")).isEmpty();
        assertThat(running.get("/api/domains/strict").path("name").asText()).isEqualTo("Strict");
        assertThat(client.status("PATCH", "/api/domains/strict", "{\"domain\":\"strict\",\"name\":\"x\"}"))
                .isEqualTo(200);
        assertThat(client.status("GET", "/ready?verbose", null)).isEqualTo(200);
    }

    @Test
    void answersADryRunAndChangesNothing() throws Exception {
        HttpResponse<byte[]> created = client.send("POST", "/api/domains?dryRun=true", "{\"domain\":\"dry\"}");
        assertThat(created.statusCode()).isEqualTo(201);
        assertThat(client.json(created).path("dryRun").asBoolean()).isTrue();
        assertThat(created.headers().firstValue("Location")).isEmpty();
        running.rejects("GET", "/api/domains/dry", null, 404, "unknown-domain");
        running.rejects("DELETE", "/api/domains/dry?dryRun=true", null, 404, "unknown-domain");
        running.rejects("POST", "/api/domains?dryRun=1", "{\"domain\":\"dry\"}", 400, "wrong-member");
        running.rejects("POST", "/api/domains?dryRun=false&dryRun=true", "{\"domain\":\"dry\"}", 400, "wrong-member");
        running.rejects("POST", "/api/domains", "{\"domain\":\"dry\",\"dryRun\":true}", 400, "unknown-member");
        running.rejects("POST", "/api/alarms/mute?dryRun=true", "{}", 400, "unknown-parameter");
    }

    @Test
    void rejectsAnInvalidFilterOfAlarms() throws Exception {
        for (String query : """
                state=opne state= state=open&state=open state=null&state=null limit=0 limit=1&limit=2 limit=x
                kind=silent from=noon to=1&to=2""".split("\\s+")) {
            assertThat(client.error("GET", "/api/alarms?" + query, null))
                    .as(query)
                    .isEqualTo("400 wrong-member");
        }
        assertThat(running.get("/api/alarms?state=closed&limit=5&kind=silent-device&from=0&to=2026-05-01T00:00:00Z"))
                .isEmpty();
    }
}
