package io.furrow.ingest;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.HashMap;
import java.util.LinkedHashSet;
import java.util.Map;
import java.util.Set;
import java.util.TreeMap;
import java.util.TreeSet;
import java.util.regex.Pattern;
import java.util.stream.Collectors;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class IngestMetricsListedTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2, METRICS.addToConfiguration(new Configuration()));

    @Test
    void existAsThePageOfTheClusterListsThem(@TempDir Path directory) throws Exception {
        try (EmbeddedMongo mongo = EmbeddedMongo.inMemory()) {
            IngestOptions options = new IngestOptions();
            JobCommandLine.of(options)
                    .parseArgs("--images", directory.resolve("images").toUri().toString(), "--mongo", mongo.uri());
            IngestRun.of(options, FixedDevices.of(), report("m1", 0), report("m2", 1));
        }

        Map<String, Set<String>> found = new TreeMap<>();
        METRICS.getMetricsByGroup().forEach((group, metrics) -> {
            String operator = group.getAllVariables().get("<operator_name>");
            if (operator != null) {
                found.computeIfAbsent(operator.replaceAll("[^A-Za-z]", "_"), name -> new TreeSet<>())
                        .addAll(metrics.keySet());
            }
        });
        Map<String, Set<String>> listed = listed();
        assertThat(listed).hasSizeGreaterThan(5);
        listed.forEach((operator, metrics) -> assertThat(found)
                .as(operator)
                .hasEntrySatisfying(
                        operator, names -> assertThat(names).as(operator).containsAll(metrics)));
        assertThat(METRICS.getMetricsByGroup().entrySet())
                .as("documents of the mission, over all subtasks")
                .filteredOn(group -> "listed"
                                .equals(group.getKey().getAllVariables().get("<mission>"))
                        && "farm".equals(group.getKey().getAllVariables().get("<domain>"))
                        && group.getValue().containsKey("documents"))
                .extracting(group -> ((Counter) group.getValue().get("documents")).getCount())
                .satisfies(counts -> assertThat(
                                counts.stream().mapToLong(Long::longValue).sum())
                        .isEqualTo(2));
    }

    /** The names in back-quotes of the lines of ingest, less those of labels and of a kind of topic. */
    private static Map<String, Set<String>> listed() throws Exception {
        Set<String> labels = Set.of("reason", "domain", "mission");
        Map<String, Set<String>> listed = new TreeMap<>();
        for (String line : Files.readAllLines(Path.of("../docs/flink-cluster.md"))) {
            String[] cells = line.split("\\|");
            if (cells.length == 4 && cells[1].trim().equals("ingest")) {
                Set<String> metrics = quoted(cells[3]);
                metrics.removeAll(labels);
                listed.put(quoted(cells[2]).iterator().next(), metrics);
            }
        }
        return listed;
    }

    private static Set<String> quoted(String text) {
        return Pattern.compile("`([^`]+)`")
                .matcher(text)
                .results()
                .map(found -> found.group(1))
                .collect(Collectors.toCollection(LinkedHashSet::new));
    }

    private static TopicRecord report(String id, long after) {
        Entity entity = Entity.builder("t", "T")
                .text("Domain", "farm")
                .text("Mission", "listed")
                .build();
        byte[] key = "t".getBytes(UTF_8);
        Map<String, String> headers = new HashMap<>(Map.of(HeaderNames.CE_ID, id));
        return new TopicRecord("data.raw", 0, 0, 1_700_000_000_000L + after, key, entity.toBytes(), headers);
    }
}
