package io.furrow.ingest;

import java.nio.file.Path;
import java.util.Base64;
import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Histogram;
import org.apache.flink.metrics.Metric;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.image.Pictures;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.EntityBuilder;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class IngestMetricsTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2, METRICS.addToConfiguration(new Configuration()));

    private static final long TIME = 1_700_000_000_000L;

    @Test
    void countsWhatPassesPerDomainAndMissionAndMeasuresEachHop(@TempDir Path images) throws Exception {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs("--images", images.toUri().toString());
        TopicRecord weeding = report("a", 0, "weeding");
        TopicRecord sowing = report("b", 0, "sowing");
        var garbage = new TopicRecord("data.raw", 0, 7, TIME, new byte[] {1}, new byte[] {'{'}, new HashMap<>());

        TopicRecord broken = camera("c", "sowing", "no picture");
        TopicRecord whole = camera("d", "weeding", Base64.getEncoder().encodeToString(Pictures.png(1)));

        IngestRun.of(options, FixedDevices.of(), weeding, weeding, weeding, sowing, garbage, broken, whole);

        assertThat(counted("routed")).containsAllEntriesOf(Map.of("", 4L, "farm/weeding", 2L, "farm/sowing", 2L));
        assertThat(counted("repeated")).containsEntry("", 2L).containsEntry("farm/weeding", 2L);
        assertThat(counted("bytes").get("farm/weeding")).isGreaterThan(weeding.value().length);
        assertThat(counted("dead"))
                .containsAllEntriesOf(Map.of("", 2L, "not-json", 1L, "not-an-image", 1L, "farm/sowing", 1L));
        assertThat(counted("images")).containsEntry("", 1L).containsEntry("farm/weeding", 1L);
        assertThat(counted("imageBytes")).containsEntry("farm/weeding", (long) Pictures.png(1).length);
        assertThat(counted("late")).containsEntry("farm/weeding", 0L);
        assertThat(largest("lagDeviceToSource")).isEqualTo(250);
        assertThat(largest("lagSourceToIngest")).isBetween(1000L, System.currentTimeMillis() - TIME);
    }

    private static TopicRecord report(String id, long after, String mission) {
        return record(
                id,
                TIME + after,
                Entity.builder("t", "T").text("Domain", "farm").text("Mission", mission));
    }

    private static TopicRecord camera(String id, String mission, String image) {
        return record(
                id,
                TIME,
                Entity.builder("t", "T")
                        .text("Domain", "farm")
                        .text("Mission", mission)
                        .text("Image", image));
    }

    private static TopicRecord record(String id, long time, EntityBuilder entity) {
        Map<String, String> headers = Map.of(
                HeaderNames.CE_ID, id,
                HeaderNames.TS_DEVICE, Long.toString(TIME),
                HeaderNames.TS_SOURCE, Long.toString(TIME + 250));
        byte[] key = "t".getBytes(UTF_8);
        return new TopicRecord("data.raw", 0, 0, time, key, entity.build().toBytes(), new HashMap<>(headers));
    }

    /** Over all subtasks, by domain and mission or by reason; under no name what has neither. */
    private static Map<String, Long> counted(String name) {
        Map<String, Long> counts = new TreeMap<>();
        METRICS.getMetricsByGroup().forEach((group, metrics) -> {
            if (metrics.get(name) instanceof Counter counter) {
                counts.merge(label(group), counter.getCount(), Long::sum);
            }
        });
        return counts;
    }

    private static String label(MetricGroup group) {
        Map<String, String> labels = group.getAllVariables();
        return labels.containsKey("<domain>")
                ? labels.get("<domain>") + "/" + labels.get("<mission>")
                : labels.getOrDefault("<reason>", "");
    }

    private static long largest(String name) {
        long largest = -1;
        for (Map<String, Metric> metrics : METRICS.getMetricsByGroup().values()) {
            if (metrics.get(name) instanceof Histogram histogram && histogram.getCount() > 0) {
                largest = Math.max(largest, histogram.getStatistics().getMax());
            }
        }
        return largest;
    }
}
