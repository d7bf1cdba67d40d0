package io.furrow.ingest;

import java.nio.charset.StandardCharsets;
import java.util.HashMap;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Histogram;
import org.apache.flink.metrics.Metric;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.JobCommandLine;
import io.furrow.flink.TopicRecord;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.Entity;

import static org.assertj.core.api.Assertions.assertThat;

class IngestMetricsTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setConfiguration(METRICS.addToConfiguration(new Configuration()))
            .setNumberTaskManagers(1)
            .setNumberSlotsPerTaskManager(2)
            .build());

    private static final long TIME = 1_700_000_000_000L;

    @Test
    void countsWhatPassesPerDomainAndMissionAndMeasuresEachHop() throws Exception {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs();
        TopicRecord weeding = report("a", 0, "weeding");
        TopicRecord sowing = report("b", 0, "sowing");
        TopicRecord garbage =
                new TopicRecord("data.raw", 0, 7, TIME, new byte[] {1}, new byte[] {'{'}, new HashMap<>());

        IngestRun.of(options, KnownDevices.of(), weeding, weeding, weeding, sowing, garbage);

        assertThat(counted("routed"))
                .containsEntry("", 2L)
                .containsEntry("farm/weeding", 1L)
                .containsEntry("farm/sowing", 1L);
        assertThat(counted("repeated")).containsEntry("", 2L).containsEntry("farm/weeding", 2L);
        assertThat(counted("bytes")).containsEntry("farm/weeding", (long) weeding.value().length);
        assertThat(counted("dead")).containsEntry("", 1L).containsEntry("not-json", 1L);
        assertThat(counted("late")).containsEntry("farm/weeding", 0L);
        assertThat(largest("lag.device-to-source")).isEqualTo(250);
        assertThat(largest("lag.source-to-ingest")).isBetween(1000L, System.currentTimeMillis() - TIME);
    }

    private static TopicRecord report(String id, long after, String mission) {
        Entity entity = Entity.builder("t", "T")
                .text("Domain", "farm")
                .text("Mission", mission)
                .build();
        Map<String, String> headers = Map.of(
                HeaderNames.CE_ID, id,
                HeaderNames.TS_DEVICE, Long.toString(TIME),
                HeaderNames.TS_SOURCE, Long.toString(TIME + 250));
        byte[] key = "t".getBytes(StandardCharsets.UTF_8);
        return new TopicRecord("data.raw", 0, 0, TIME + after, key, entity.toBytes(), new HashMap<>(headers));
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
