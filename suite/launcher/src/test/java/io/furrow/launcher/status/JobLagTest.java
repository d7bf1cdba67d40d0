package io.furrow.launcher.status;

import java.net.URI;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;

import io.furrow.launcher.status.JobLag.Lag;
import io.furrow.stub.StubServer;

import static org.assertj.core.api.Assertions.assertThat;

class JobLagTest {
    private final Map<String, String> answers = new HashMap<>();

    @AutoClose
    private final StubServer flink = new StubServer(exchange -> StubServer.answer(
            exchange, 200, answers.getOrDefault(exchange.getRequestURI().toString(), "[]")));

    private final URI uri = flink.uri("");

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
