package io.furrow.control.rest;

import java.net.Socket;
import java.net.SocketTimeoutException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Clock;
import java.util.Arrays;
import java.util.List;
import java.util.regex.Pattern;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestInstance;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.http.AllowedNames;
import io.furrow.kafka.Readiness;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** Sends requests that the API rejects. */
@TestInstance(TestInstance.Lifecycle.PER_CLASS)
@Tag("full")
class RestApiAccessIT {
    private Path directory;

    @AutoClose
    private RunningApi running;

    private ApiClient client;

    @BeforeAll
    void start(@TempDir Path temporary) throws Exception {
        directory = temporary;
        running = new RunningApi(directory);
        client = running.client();
    }

    /** Slow bodies would occupy threads. */
    @Test
    void rejectsASlowBody() throws Exception {
        URI uri = running.api().uri();
        try (Socket socket = new Socket(uri.getHost(), uri.getPort())) {
            String head =
                    "POST /api/domains HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 1000\r\n\r\n";
            socket.getOutputStream().write(head.getBytes(US_ASCII));
            socket.setSoTimeout(200);
            String answer = "";
            for (int i = 0; i < 900 && answer.isEmpty(); i++) {
                socket.getOutputStream().write(' ');
                try {
                    answer = new String(socket.getInputStream().readNBytes(12), US_ASCII);
                } catch (SocketTimeoutException e) {
                    // the next byte
                }
            }
            assertThat(answer).isEqualTo("HTTP/1.1 408");
        }
    }

    /** An early rejection is sent after the body was read, else the connection and the next request would fail. */
    @Test
    void answersTheNextRequestAfterAnUnusedBody() throws Exception {
        for (String rejected :
                List.of("POST /api/fields?domain=a.b", "POST /api/nosuch", "DELETE /api/domains/nosuch")) {
            URI uri = running.api().uri();
            try (Socket socket = new Socket(uri.getHost(), uri.getPort())) {
                socket.setSoTimeout(200);
                String head = rejected
                        + " HTTP/1.1\r\nHost: localhost\r\nContent-Type: application/json\r\nContent-Length: 9\r\n\r\n";
                socket.getOutputStream().write(head.getBytes(US_ASCII));
                assertThatThrownBy(() -> socket.getInputStream().read())
                        .as(rejected)
                        .isInstanceOf(SocketTimeoutException.class);
                socket.setSoTimeout((int) RunningApi.TIMEOUT.toMillis());
                String next = "{\"a\": 1 }GET /health HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n";
                socket.getOutputStream().write(next.getBytes(US_ASCII));

                assertThat(new String(socket.getInputStream().readAllBytes(), US_ASCII))
                        .as(rejected)
                        .startsWith("HTTP/1.1 4")
                        .contains("HTTP/1.1 200");
            }
        }
    }

    @Test
    void explainsRejections() throws Exception {
        running.rejects("POST", "/api/domains", "{\"domain\":", 400, "not-json");
        running.rejects("POST", "/api/domains", "[]", 400, "not-a-request");
        running.rejects("POST", "/api/domains", "{\"domain\":\"\\ud800\"}", 400, "not-json");
        running.rejects("POST", "/api/domains", "{}", 400, "missing-member");
        running.rejects("POST", "/api/domains", "{\"domain\":\"x\",\"name\":7}", 400, "wrong-member");
        running.rejects("GET", "/api/audit?limit=0", null, 400, "wrong-member");
        assertThat(client.error("GET", "/api/nosuch", null, false)).isEqualTo("404 not-found");
        assertThat(client.error("PUT", "/api/domains", "{}", false)).isEqualTo("405 method-not-allowed");
        assertThat(client.error("POST", "/api/domains", "{}", "Content-Type", "text/plain"))
                .isEqualTo("415 unsupported-media-type");
        assertThat(client.error("POST", "/api/domains", "{}", "Idempotency-Key", "a b"))
                .isEqualTo("400 wrong-header");
        assertThat(client.error("POST", "/api/domains", "{}", "Origin", "http://evil.example"))
                .isEqualTo("403 foreign-origin");
        assertThat(client.raw("/api/domains", "evil.example"))
                .contains(
                        " 403 ",
                        "application/problem+json",
                        "\"error\":\"foreign-host\"",
                        "'evil.example'",
                        "--allowed-hosts");
        assertThat(client.raw("/health", "10.9.8.7:8085")).as("a probe").contains(" 200 ");
        assertThat(client.raw("/metrics", "10.9.8.7:8085")).contains(" 403 ");
        assertThat(client.raw("/api/domains/a%2Fb", "localhost"))
                .contains(" 400 ", "application/problem+json", "\"title\":\"Bad Request\",\"status\":400");
        assertThat(client.error("GET", "/api/devices/M%25C3%25BCller", null, false))
                .as("a percent sign in an id")
                .isEqualTo("404 unknown-device");
        byte[] large = new byte[9 * 1024 * 1024];
        Arrays.fill(large, (byte) ' ');
        assertThat(client.error("POST", "/api/domains", new String(large))).isEqualTo("413 too-large");
    }

    @Test
    void requiresATokenIfConfigured() throws Exception {
        Path tokens = directory.resolve("tokens");
        Files.writeString(tokens, "# who may\nann a-token-of-sixteen-signs operator\n");
        RestSettings settings = RestSettings.on(0)
                .withTokens(tokens)
                .withAllowed(new AllowedNames(List.of("farm.example.org"), List.of()));
        try (RestApi other = RestApi.start(running.settings(), settings, new Readiness(Clock.systemUTC()))) {
            ApiClient anonymous = new ApiClient(other.uri(), null);
            ApiClient ann = new ApiClient(other.uri(), "a-token-of-sixteen-signs");
            await().until(() -> anonymous.status("GET", "/ready", null) == 200);
            for (String path :
                    new String[] {"/api/domains", "//api/domains", "/api/../api/domains", "/api;x/domains"}) {
                assertThat(anonymous.raw(path, "localhost")).as(path).containsAnyOf(" 401 ", " 400 ");
            }
            assertThat(anonymous.raw("/api/domains", "farm.example.org")).contains(" 401 ");
            checkPage(anonymous);
            assertThat(anonymous.raw("/api/domains", "evil.example")).contains(" 403 ", "foreign-host");
            assertThat(ann.error("GET", "/api/domains", null, "Origin", "https://evil.example"))
                    .isEqualTo("403 foreign-origin");
            assertThat(anonymous.error("GET", "/api/domains", null)).isEqualTo("401 unauthorized");
            assertThat(client.error(
                            new ApiClient(other.uri(), "another-token-of-signs").send("GET", "/api/domains", null)))
                    .isEqualTo("401 unauthorized");
            assertThat(ann.send("GET", "/api/domains", null).statusCode()).isEqualTo(200);
            assertThat(ann.error("POST", "/api/domains", "{\"domain\":\"ann-s\",\"user\":\"bob\"}"))
                    .isEqualTo("400 unknown-member");
            ann.send("POST", "/api/domains", "{\"domain\":\"ann-s\"}");
        }
        await().untilAsserted(() -> assertThat(running.get("/api/audit?limit=1000"))
                .anyMatch(entry -> entry.path("user").asText().equals("ann")
                        && entry.at("/about/domain").asText().equals("ann-s")));
    }

    /** The page that shows the description is public like this, and loads nothing from elsewhere. */
    private static void checkPage(ApiClient anonymous) throws Exception {
        String page = anonymous.raw("/api/", "localhost");
        assertThat(page).startsWith("HTTP/1.1 200 ").contains("Content-Security-Policy: default-src 'self';");
        assertThat(anonymous.raw("/api", "localhost")).contains("\r\nLocation: /api/\r\n");
        List<String> files = Pattern.compile("(?:src|href)=\"(/[^\"]*)\"")
                .matcher(page)
                .results()
                .map(found -> found.group(1))
                .toList();
        assertThat(files).hasSize(3);
        for (String file : files) {
            assertThat(anonymous.raw(file, "localhost"))
                    .as(file)
                    .startsWith("HTTP/1.1 200 ")
                    .contains("Content-Security-Policy: ", "X-Content-Type-Options: nosniff");
        }
        assertThat(anonymous.raw("/api/page/swagger-ui-bundle.js.LICENSE.txt", "localhost"))
                .contains("MIT");
        assertThat(anonymous.raw("/api/page/none.js", "localhost")).startsWith("HTTP/1.1 404 ");
    }
}
