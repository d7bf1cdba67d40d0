package io.furrow.control.rest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Arrays;

import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** What the API does not let pass. */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
class RestApiAccessIT {
    private Path directory;
    private RunningApi running;
    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path temporary) throws Exception {
        directory = temporary;
        running = new RunningApi(directory);
        client = running.client();
    }

    @AfterAll
    void stop() {
        running.close();
    }

    @Test
    void saysWhatIsWrongWithARequest() throws Exception {
        running.refused("POST", "/api/domains", "{\"domain\":", 400, "not-json");
        running.refused("POST", "/api/domains", "[]", 400, "not-a-request");
        running.refused("POST", "/api/domains", "{\"domain\":\"\\ud800\"}", 400, "not-json");
        running.refused("POST", "/api/domains", "{}", 400, "missing-member");
        running.refused("POST", "/api/domains", "{\"domain\":\"x\",\"name\":7}", 400, "wrong-member");
        running.refused("GET", "/api/audit?limit=0", null, 400, "wrong-member");
        assertThat(client.error(client.send("GET", "/api/nosuch", null, false))).isEqualTo("404 not-found");
        assertThat(client.error(client.send("PUT", "/api/domains", "{}", false)))
                .isEqualTo("405 method-not-allowed");
        assertThat(client.error(client.send("POST", "/api/domains", "{}", "Content-Type", "text/plain")))
                .isEqualTo("415 unsupported-media-type");
        assertThat(client.error(client.send("POST", "/api/domains", "{}", "Idempotency-Key", "a b")))
                .isEqualTo("400 wrong-header");
        assertThat(client.error(client.send("POST", "/api/domains", "{}", "Origin", "http://evil.example")))
                .isEqualTo("403 foreign-origin");
        assertThat(client.raw("/api/domains", "evil.example")).contains(" 403 ", "foreign-host");
        assertThat(client.raw("/api/domains/a%2Fb", "localhost"))
                .contains(" 400 ", "{\"type\":\"response\",\"status\":\"error\"");
        byte[] large = new byte[9 * 1024 * 1024];
        Arrays.fill(large, (byte) ' ');
        assertThat(client.error(client.send("POST", "/api/domains", new String(large))))
                .isEqualTo("413 too-large");
    }

    @Test
    void asksForATokenWhereItHasSome() throws Exception {
        Path tokens = directory.resolve("tokens");
        Files.writeString(tokens, "# who may\nann a-token-of-sixteen-signs\n");
        try (RestApi other =
                RestApi.start(running.settings(), RestSettings.on(0).withTokens(tokens), () -> "RUNNING")) {
            ApiClient nobody = new ApiClient(other.uri(), null);
            ApiClient ann = new ApiClient(other.uri(), "a-token-of-sixteen-signs");
            await().atMost(RunningApi.PATIENCE)
                    .until(() -> nobody.send("GET", "/health", null).statusCode() == 200);
            for (String path :
                    new String[] {"/api/domains", "//api/domains", "/api/../api/domains", "/api;x/domains"}) {
                assertThat(nobody.raw(path, "localhost")).as(path).containsAnyOf(" 401 ", " 400 ");
            }
            assertThat(client.error(nobody.send("GET", "/api/domains", null))).isEqualTo("401 unauthorized");
            assertThat(client.error(
                            new ApiClient(other.uri(), "another-token-of-signs").send("GET", "/api/domains", null)))
                    .isEqualTo("401 unauthorized");
            assertThat(ann.send("GET", "/api/domains", null).statusCode()).isEqualTo(200);
            ann.send("POST", "/api/domains", "{\"domain\":\"ann-s\",\"user\":\"bob\"}");
        }
        await().atMost(RunningApi.PATIENCE)
                .untilAsserted(() -> assertThat(running.get("/api/audit?limit=1000"))
                        .anyMatch(entry -> entry.path("user").asText().equals("ann")
                                && entry.at("/about/domain").asText().equals("ann-s")));
    }
}
