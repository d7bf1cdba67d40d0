package io.furrow.launcher.status;

import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.URI;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;

import com.sun.net.httpserver.HttpServer;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.launcher.status.JobLag.Lag;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class JobLagTest {
    private final Map<String, String> answers = new HashMap<>();
    private HttpServer flink;
    private URI uri;

    @BeforeEach
    void start() throws Exception {
        flink = HttpServer.create(new InetSocketAddress(InetAddress.getLoopbackAddress(), 0), 0);
        flink.createContext("/", exchange -> {
            byte[] body = answers.getOrDefault(exchange.getRequestURI().toString(), "[]")
                    .getBytes(UTF_8);
            exchange.sendResponseHeaders(200, body.length);
            exchange.getResponseBody().write(body);
            exchange.close();
        });
        flink.start();
        uri = URI.create("http://127.0.0.1:" + flink.getAddress().getPort());
    }

    @AfterEach
    void stop() {
        flink.stop(0);
    }

    @Test
    void reportsForAJobHowFarItsWorstSourceIsBehind() throws Exception {
        job("1", Map.of("a", "Source: Read reported changes -> Read positions", "b", "Grid"));
        metric("1", "a", "Source__Read_reported_changes.pendingRecords", 7);
        job(
                "2",
                Map.of(
                        "c", "Source: Read reported events -> Recognize events",
                        "d", "Source: Read devices -> Recognize devices"));
        metric("2", "c", "Source__Read_reported_events.pendingRecords", 5);
        metric("2", "d", "Source__Read_devices.pendingRecords", 0);
        JobLag lag = new JobLag(uri, Map.of("collision", "1", "ingest", "2"));

        assertThat(lag.read())
                .containsExactlyInAnyOrderEntriesOf(Map.of(
                        "collision", Optional.of(new Lag("", 7)),
                        "ingest", Optional.of(new Lag("reported events", 5))));
    }

    @Test
    void pollsASourceThatHasNotReadYet() throws Exception {
        job("2", Map.of("c", "Source: Read reported events", "d", "Source: Read devices"));
        JobLag lag = new JobLag(uri, Map.of("ingest", "2"));
        assertThat(lag.read()).containsExactly(Map.entry("ingest", Optional.empty()));

        metric("2", "c", "Source__Read_reported_events.pendingRecords", 5);
        assertThat(lag.read()).containsExactly(Map.entry("ingest", Optional.of(new Lag("", 5))));

        metric("2", "d", "Source__Read_devices.pendingRecords", 6);
        assertThat(lag.read()).containsExactly(Map.entry("ingest", Optional.of(new Lag("devices", 6))));
    }

    private void job(String id, Map<String, String> vertices) {
        StringBuilder json = new StringBuilder();
        vertices.forEach((vertex, name) -> json.append(json.isEmpty() ? "" : ",")
                .append("{\"id\":\"%s\",\"name\":\"%s\"}".formatted(vertex, name)));
        answers.put("/jobs/" + id, "{\"vertices\":[" + json + "]}");
    }

    private void metric(String job, String vertex, String id, long sum) {
        String path = "/jobs/" + job + "/vertices/" + vertex + "/subtasks/metrics";
        answers.put(path, "[{\"id\":\"0.other\"},{\"id\":\"" + id + "\"}]");
        answers.put(path + "?agg=sum&get=" + id, "[{\"id\":\"" + id + "\",\"sum\":" + sum + "}]");
    }
}
