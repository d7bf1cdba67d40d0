package io.furrow.embedded;

import java.io.IOException;
import java.net.InetAddress;
import java.net.Socket;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import org.junit.jupiter.api.AfterAll;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import io.furrow.http.AllowedNames;

import static java.nio.charset.StandardCharsets.US_ASCII;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/** The access rule at the REST APIs of the real engines. */
@Tag("full")
class RestAccessIT {
    private static final String PAGE = "https://map.example.org";
    private static final int TIMEOUT_MS = 60_000;

    private static EmbeddedKafka kafka;
    private static EmbeddedConnect connect;
    private static EmbeddedFlink flink;

    @BeforeAll
    static void start(@TempDir Path directory) throws IOException {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        connect = EmbeddedConnect.start(
                kafka.bootstrapServers(),
                Files.createDirectory(directory.resolve("plugins")),
                0,
                Map.of(),
                new AllowedNames(List.of("connect.farm"), List.of(PAGE)));
        flink = EmbeddedFlink.start(1, 0, new AllowedNames(List.of("flink.farm"), List.of(PAGE)));
    }

    @AfterAll
    static void stop() {
        flink.close();
        connect.close();
        kafka.close();
    }

    /** What is asked for, under which further name, and where the text of an error is. */
    record Api(String name, String path, String host, String error, String option) {
        URI uri() {
            return name.equals("connect") ? connect.uri() : flink.webUi();
        }

        @Override
        public String toString() {
            return name;
        }
    }

    static Stream<Api> apis() {
        return Stream.of(
                new Api(
                        "connect",
                        "/connectors",
                        "connect.farm",
                        "{\"error_code\":403,\"message\":\"",
                        "furrow.http.allowed.hosts"),
                new Api("flink", "/config", "flink.farm", "{\"errors\":[\"", "furrow.http.allowed-hosts"));
    }

    @ParameterizedTest
    @MethodSource("apis")
    void rejectsAForeignHostInItsOwnShape(Api api) throws IOException {
        String answer = request(api, "GET " + api.path(), "Host: evil.example");

        assertThat(answer).startsWith("HTTP/1.1 403 ").contains(api.error(), "'evil.example'", api.option());
        assertThat(answer).containsIgnoringCase("content-type: application/json");
        assertThat(request(api, "GET " + api.path(), "Host: " + api.host() + ":80"))
                .startsWith("HTTP/1.1 200 ");
        assertThat(request(api, "GET " + api.path(), "Host: localhost")).startsWith("HTTP/1.1 200 ");
    }

    @ParameterizedTest
    @MethodSource("apis")
    void rejectsAForeignPageAlsoWithABody(Api api) throws IOException {
        String headers = "Host: localhost\r\nOrigin: https://evil.example";
        String small = request(api, "POST " + api.path(), headers, "{}");
        String begunOnly = request(api, "POST " + api.path(), headers + "\r\nContent-Length: 200000");

        assertThat(small).startsWith("HTTP/1.1 403 ").contains("https://evil.example");
        assertThat(begunOnly).startsWith("HTTP/1.1 403 ").contains("https://evil.example");
    }

    @ParameterizedTest
    @MethodSource("apis")
    void letsAnAllowedPageRead(Api api) throws IOException {
        String headers = "Host: localhost\r\nOrigin: " + PAGE;

        assertThat(request(api, "GET " + api.path(), headers))
                .startsWith("HTTP/1.1 200 ")
                .containsIgnoringCase("Access-Control-Allow-Origin: " + PAGE);
        assertThat(request(api, "OPTIONS " + api.path(), headers + "\r\nAccess-Control-Request-Method: PUT"))
                .startsWith("HTTP/1.1 204 ")
                .containsIgnoringCase("Access-Control-Allow-Methods: PUT");
        assertThat(request(api, "GET " + api.path(), "Host: localhost")).doesNotContainIgnoringCase("allow-origin");
    }

    /** What Flink itself does not check. */
    @Test
    void rejectsAtFlinkWhatNamesTwoHostsOrAnotherInItsTarget() throws IOException {
        Api api = apis().skip(1).findFirst().orElseThrow();

        assertThat(request(api, "GET /config", "Host: localhost\r\nHost: localhost"))
                .startsWith("HTTP/1.1 403 ");
        assertThat(request(api, "GET http://evil.example/config", "Host: localhost"))
                .startsWith("HTTP/1.1 403 ");
        assertThat(request(api, "GET /config", "X-Host: localhost")).startsWith("HTTP/1.1 403 ");
    }

    @Test
    void writesNoUploadToTheDiskBeforeItRejects() throws IOException {
        Api api = apis().skip(1).findFirst().orElseThrow();
        Path temporary = Path.of(System.getProperty("java.io.tmpdir"));
        long before = jars(temporary);
        String body = "--x\r\nContent-Disposition: form-data; name=\"jarfile\"; filename=\"furrow-evil.jar\"\r\n"
                + "Content-Type: application/x-java-archive\r\n\r\nPK\r\n--x--\r\n";

        for (String path : List.of("/jars/upload", "/jobs")) {
            String answer = request(
                    api, "POST " + path, "Host: localhost\r\nContent-Type: multipart/form-data; boundary=x", body);

            assertThat(answer).startsWith("HTTP/1.1 403 ").contains("furrow.http.read-only");
        }
        assertThat(jars(temporary)).isEqualTo(before);
    }

    private static long jars(Path folder) throws IOException {
        try (Stream<Path> files = Files.walk(folder, 3)) {
            return files.filter(file -> file.getFileName().toString().endsWith("furrow-evil.jar"))
                    .count();
        } catch (java.io.UncheckedIOException e) { // something of another process has gone meanwhile
            return jars(folder);
        }
    }

    private static String request(Api api, String requestLine, String headers) throws IOException {
        return request(api, requestLine, headers, "");
    }

    private static String request(Api api, String requestLine, String headers, String body) throws IOException {
        String length = body.isEmpty() ? "" : "Content-Length: " + body.length() + "\r\n";
        String request = requestLine + " HTTP/1.1\r\nConnection: close\r\n" + headers + "\r\n" + length + "\r\n" + body;
        try (var socket = new Socket(InetAddress.getLoopbackAddress(), api.uri().getPort())) {
            socket.setSoTimeout(TIMEOUT_MS);
            socket.getOutputStream().write(request.getBytes(US_ASCII));
            return new String(socket.getInputStream().readAllBytes(), UTF_8);
        }
    }
}
