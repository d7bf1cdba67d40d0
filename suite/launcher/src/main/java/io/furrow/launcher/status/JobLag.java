package io.furrow.launcher.status;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.time.Duration;
import java.util.Locale;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;
import java.util.regex.Pattern;

import com.fasterxml.jackson.databind.JsonNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;

/**
 * Measures the lag of each job in records, by Flink's metric {@code pendingRecords} (at most 10 s old); of a job with several
 * sources, the greatest.
 */
final class JobLag {
    private static final Logger LOG = LoggerFactory.getLogger(JobLag.class);
    private static final String METRIC_END = ".pendingRecords";
    /** The prefixes of a source's vertex by Flink and by Furrow. */
    private static final Pattern SOURCE = Pattern.compile("^(.*\\.)?Source__(Read_)?");

    private final HttpClient http =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final URI flink;
    private final Map<String, String> jobs;
    /** By job, then by source. */
    private final Map<String, Map<String, URI>> metrics = new TreeMap<>();

    /** @param jobs ids by name */
    JobLag(URI flink, Map<String, String> jobs) {
        this.flink = flink;
        this.jobs = jobs;
    }

    /** @param source empty if the job has only one */
    record Lag(String source, long records) {}

    /** By job; empty if it has not reported yet, or while Flink is too busy to answer. */
    Map<String, Optional<Lag>> read() throws InterruptedException {
        Map<String, Optional<Lag>> lags = new TreeMap<>();
        for (String name : jobs.keySet()) {
            try {
                lags.put(name, pending(name));
            } catch (IOException e) {
                LOG.debug("no lag of {}", name, e);
                lags.put(name, Optional.empty());
            }
        }
        return lags;
    }

    private Optional<Lag> pending(String name) throws IOException, InterruptedException {
        Map<String, URI> sources = metrics.get(name);
        if (sources == null) {
            Sources found = find(jobs.get(name));
            sources = found.metrics();
            if (found.areAllThere()) {
                metrics.put(name, sources);
            }
        }
        Optional<Lag> worst = Optional.empty();
        for (Map.Entry<String, URI> source : sources.entrySet()) {
            JsonNode sum = get(source.getValue()).path(0).path("sum");
            if (sum.isNumber() && sum.longValue() > worst.map(Lag::records).orElse(-1L)) {
                worst = Optional.of(new Lag(sources.size() == 1 ? "" : source.getKey(), sum.longValue()));
            }
        }
        return worst;
    }

    /** A source has the metric after its first read. */
    private record Sources(Map<String, URI> metrics, boolean areAllThere) {}

    private Sources find(String job) throws IOException, InterruptedException {
        Map<String, URI> found = new TreeMap<>();
        int sources = 0;
        for (JsonNode vertex : get(flink.resolve("/jobs/" + job)).path("vertices")) {
            if (!vertex.path("name").asText().startsWith("Source: ")) {
                continue;
            }
            sources++;
            URI all = flink.resolve(
                    "/jobs/" + job + "/vertices/" + vertex.path("id").asText() + "/subtasks/metrics");
            for (JsonNode metric : get(all)) {
                String id = metric.path("id").asText();
                if (id.endsWith(METRIC_END)) {
                    found.put(source(id), URI.create(all + "?agg=sum&get=" + id));
                }
            }
        }
        return new Sources(found, sources > 0 && found.size() == sources);
    }

    private static String source(String metric) {
        String operator = metric.substring(0, metric.length() - METRIC_END.length());
        return SOURCE.matcher(operator).replaceFirst("").replace('_', ' ').toLowerCase(Locale.ROOT);
    }

    private JsonNode get(URI uri) throws IOException, InterruptedException {
        HttpRequest request =
                HttpRequest.newBuilder(uri).timeout(Duration.ofSeconds(2)).build();
        return NgsiJson.mapper()
                .readTree(http.send(request, HttpResponse.BodyHandlers.ofByteArray())
                        .body());
    }
}
