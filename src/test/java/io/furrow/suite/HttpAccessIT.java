package io.furrow.suite;

import java.io.IOException;
import java.net.URI;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.TreeSet;
import java.util.stream.Collectors;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.launcher.suite.Suite;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * Requests that a page of a foreign host could make a browser send, to every HTTP port of this JVM, including ports
 * that no test lists.
 */
@Tag("full")
class HttpAccessIT {
    private static final String BOUNDARY = "frontier";
    /** Paths that change or show something on one of the servers. */
    private static final List<String> PATHS = List.of("""
                    / /config /connectors /jars/upload /jobs /v2/entities /v2/notify /iot/devices /api/domains
                    /nothing-is-here""".split("\\s+"));

    @AutoClose
    private static RunningSuite running;

    private static Set<Integer> httpPorts;

    @BeforeAll
    static void startAndFindEveryHttpPort() throws Exception {
        running = RunningSuite.start(null);
        httpPorts = ListeningPorts.ofThisJvm().parallelStream()
                .filter(RawHttp::isSpokenAt)
                .collect(Collectors.toCollection(TreeSet::new));
    }

    @Test
    void findsTheServersByTheirPorts() {
        Suite suite = running.suite();

        assertThat(httpPorts)
                .contains(
                        suite.flink().getPort(),
                        suite.connect().getPort(),
                        suite.control().getPort(),
                        suite.health().getPort(),
                        suite.listener().getPort(),
                        suite.contextBroker().getPort(),
                        suite.devices().iotAgent().getPort());
        assertThat(httpPorts)
                .as("ports of other protocols are excluded")
                .doesNotContain(
                        suite.devices().mqtt().getPort(),
                        URI.create(suite.mongo()).getPort());
    }

    @Test
    void rejectsAForeignHostOnEveryHttpPort() throws IOException {
        List<String> accepted = new ArrayList<>();
        for (int port : httpPorts) {
            for (String host : List.of("evil.example", "evil.example:" + port, "127.0.0.1.evil.example:" + port)) {
                accepted.addAll(accepted(port, "Host: " + host));
            }
        }

        assertThat(accepted).isEmpty();
    }

    @Test
    void rejectsAForeignOriginOnEveryHttpPort() throws IOException {
        List<String> accepted = new ArrayList<>();
        for (int port : httpPorts) {
            for (String origin : List.of("https://evil.example", "null", "http://127.0.0.1:1", "http://localhost")) {
                accepted.addAll(accepted(port, "Host: 127.0.0.1:" + port, "Origin: " + origin));
            }
        }

        assertThat(accepted).isEmpty();
    }

    @Test
    void rejectsWebSocketsAndPreflightsOfForeignPages() throws IOException {
        List<String> accepted = new ArrayList<>();
        for (int port : httpPorts) {
            String[] foreign = {"Host: 127.0.0.1:" + port, "Origin: https://evil.example"};
            String webSocket =
                    RawHttp.head("GET", "/", foreign).replace("Connection: close", "Connection: Upgrade, close")
                            + "Upgrade: websocket\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n";
            String preflight =
                    RawHttp.head("OPTIONS", "/connectors", foreign) + "Access-Control-Request-Method: PUT\r\n\r\n";
            addIfAccepted(port, webSocket, accepted);
            addIfAccepted(port, preflight, accepted);
        }

        assertThat(accepted).isEmpty();
    }

    @Test
    void allowsNoForeignPageToReadResponses() throws IOException {
        for (int port : httpPorts) {
            assertThat(RawHttp.send(port, RawHttp.get("/config", "Host: localhost:" + port)))
                    .hasValueSatisfying(answer -> assertThat(answer.text()).doesNotContainIgnoringCase("allow-origin"));
        }
    }

    @Test
    void answersUnderItsOwnNames() throws IOException {
        Suite suite = running.suite();
        for (String name : List.of("127.0.0.1", "localhost", "LOCALHOST", "localhost.", "127.9.8.7", "[::1]")) {
            assertThat(statusOfGet(suite.flink(), "/config", name)).as(name).isEqualTo(200);
            assertThat(statusOfGet(suite.connect(), "/connectors", name))
                    .as(name)
                    .isEqualTo(200);
            assertThat(statusOfGet(suite.control(), "/openapi.json", name))
                    .as(name)
                    .isEqualTo(200);
            assertThat(statusOfGet(suite.contextBroker(), "/v2/entities", name))
                    .as(name)
                    .isEqualTo(200);
            assertThat(statusOfGet(suite.listener(), "/metrics", name)).as(name).isEqualTo(200);
            assertThat(statusOfGet(suite.health(), "/metrics", name)).as(name).isEqualTo(200);
        }
    }

    @Test
    void answersProbesUnderAnyName() throws IOException {
        Suite suite = running.suite();
        for (URI server : List.of(suite.health(), suite.control())) {
            assertThat(statusOfGet(server, "/health", "10.1.2.3")).isEqualTo(200);
            assertThat(statusOfGet(server, "/metrics", "10.1.2.3")).isEqualTo(403);
        }
    }

    @Test
    void rejectsJarsJobsAndCommandsAtFlink() throws IOException {
        int flink = running.suite().flink().getPort();
        String job = running.suite().jobs().values().iterator().next();

        for (String request : List.of(
                upload("/jars/upload", "jarfile", flink),
                upload("/jobs", "file_0", flink),
                RawHttp.simplePost("/jobs/" + job + "/stop", "{\"drain\":true}", "Host: localhost:" + flink),
                RawHttp.simplePost("/jobs/" + job + "/savepoints", "{}", "Host: localhost:" + flink),
                RawHttp.get("/jobs/" + job + "/yarn-cancel", "Host: localhost:" + flink),
                RawHttp.head("PATCH", "/jobs/" + job, "Host: localhost:" + flink) + "\r\n",
                RawHttp.head("DELETE", "/cluster", "Host: localhost:" + flink) + "\r\n")) {
            assertThat(RawHttp.send(flink, request))
                    .as(request)
                    .hasValueSatisfying(answer -> assertThat(answer.status()).isEqualTo(403));
        }
        assertThat(RawHttp.send(flink, RawHttp.get("/jobs/" + job, "Host: localhost:" + flink)))
                .hasValueSatisfying(answer -> assertThat(answer.text()).contains("\"state\":\"RUNNING\""));
    }

    private static String upload(String path, String part, int port) {
        String body = "--" + BOUNDARY + "\r\nContent-Disposition: form-data; name=\"" + part
                + "\"; filename=\"evil.jar\"\r\nContent-Type: application/x-java-archive\r\n\r\nPK\r\n--" + BOUNDARY
                + "--\r\n";
        return RawHttp.head("POST", path, "Host: localhost:" + port) + "Content-Type: multipart/form-data; boundary="
                + BOUNDARY + "\r\nContent-Length: " + body.length() + "\r\n\r\n" + body;
    }

    private static int statusOfGet(URI server, String path, String name) throws IOException {
        return RawHttp.send(server.getPort(), RawHttp.get(path, "Host: " + name + ":" + server.getPort()))
                .map(RawHttp.Answer::status)
                .orElse(0);
    }

    private static List<String> accepted(int port, String... headers) throws IOException {
        List<String> accepted = new ArrayList<>();
        for (String path : PATHS) {
            addIfAccepted(port, RawHttp.get(path, headers), accepted);
            addIfAccepted(port, RawHttp.simplePost(path, "{}", headers), accepted);
        }
        return accepted;
    }

    private static void addIfAccepted(int port, String request, List<String> accepted) throws IOException {
        int status = RawHttp.send(port, request).map(RawHttp.Answer::status).orElse(0);
        if (status != 403) {
            accepted.add(status + " of port " + port + " to " + request.replace("\r\n", " | "));
        }
    }
}
