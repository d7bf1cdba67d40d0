package io.furrow.launcher.status;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.Map;
import java.util.OptionalLong;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;

/** How many records each job has still to read, as Flink's own metric {@code pendingRecords} says (at most 10 s old). */
final class JobLag {
    private static final Logger LOG = LoggerFactory.getLogger(JobLag.class);
    private static final String METRIC_END = ".pendingRecords";

    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final URI flink;
    private final Map<String, String> jobs;
    private final Map<String, URI> metrics = new TreeMap<>();

    /** @param jobs ids by name */
    JobLag(URI flink, Map<String, String> jobs) {
        this.flink = flink;
        this.jobs = jobs;
    }

    /** Pending records by job; empty for a job that has not told yet, or while Flink is too busy to tell. */
    Map<String, OptionalLong> read() throws InterruptedException {
        Map<String, OptionalLong> lags = new TreeMap<>();
        for (String name : jobs.keySet()) {
            try {
                lags.put(name, pending(name));
            } catch (IOException e) {
                LOG.debug("no lag of {}", name, e);
                lags.put(name, OptionalLong.empty());
            }
        }
        return lags;
    }

    private OptionalLong pending(String name) throws IOException, InterruptedException {
        URI metric = metrics.get(name);
        if (metric == null) {
            metric = find(jobs.get(name));
            if (metric == null) {
                return OptionalLong.empty();
            }
            metrics.put(name, metric);
        }
        JsonNode sum = get(metric).path(0).path("sum");
        return sum.isNumber() ? OptionalLong.of(sum.longValue()) : OptionalLong.empty();
    }

    /** The source is the first vertex; its metric's name holds the operator's name. */
    private URI find(String job) throws IOException, InterruptedException {
        for (JsonNode vertex : get(flink.resolve("/jobs/" + job)).path("vertices")) {
            URI all = flink.resolve(
                    "/jobs/" + job + "/vertices/" + vertex.path("id").asText() + "/subtasks/metrics");
            for (JsonNode metric : get(all)) {
                String id = metric.path("id").asText();
                if (id.endsWith(METRIC_END)) {
                    return URI.create(all + "?agg=sum&get=" + id);
                }
            }
        }
        return null;
    }

    private JsonNode get(URI uri) throws IOException, InterruptedException {
        HttpRequest request =
                HttpRequest.newBuilder(uri).timeout(Duration.ofSeconds(2)).build();
        return NgsiJson.mapper()
                .readTree(http.send(request, HttpResponse.BodyHandlers.ofByteArray())
                        .body());
    }
}
