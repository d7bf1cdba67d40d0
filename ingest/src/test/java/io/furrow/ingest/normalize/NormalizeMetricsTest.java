package io.furrow.ingest.normalize;

import java.time.Duration;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.concurrent.CopyOnWriteArrayList;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Metric;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.logging.log4j.Level;
import org.apache.logging.log4j.LogManager;
import org.apache.logging.log4j.core.LogEvent;
import org.apache.logging.log4j.core.Logger;
import org.apache.logging.log4j.core.appender.AbstractAppender;
import org.apache.logging.log4j.core.config.Configurator;
import org.apache.logging.log4j.core.config.Property;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.flink.TestClusters;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.record.TopicRecord;
import io.furrow.ingest.CollectedOutput;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class NormalizeMetricsTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(2, METRICS.addToConfiguration(new Configuration()));

    private static final long RECEIVED = 1_700_000_060_000L;

    @Test
    void countsWhatBecameOfEachEntity() throws Exception {
        long ahead = RECEIVED + Duration.ofMinutes(6).toMillis();
        NormalizeOptions options = new NormalizeOptions();
        JobCommandLine.of(options).parseArgs();
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        env.setParallelism(1);
        DataStream<TopicRecord> notifications = env.fromData(List.of(
                        notification(
                                "{'data':[{'id':'a','type':'T'},{'id':'b','type':'T'},{'id':'c','type':'Domain'}]}"),
                        notification("{'data':[{'id':'d','type':'T','Time':" + ahead + "}]}"),
                        notification("{'data':[{'type':'T'}]}"),
                        notification("{")))
                .uid("records")
                .assignTimestampsAndWatermarks(WatermarkStrategy.noWatermarks())
                .uid("timestamps");
        CollectedOutput out = new CollectedOutput();
        NormalizeJob.define(notifications, out, options);

        List<String> warnings = warningsOf(out);

        assertThat(warnings)
                .singleElement()
                .satisfies(warning ->
                        assertThat(warning).contains("|d ", "too far ahead").endsWith("raise --max-clock-skew"));
        assertThat(counted("accepted")).containsEntry("", 3L);
        assertThat(counted("excluded")).containsEntry("", 1L);
        assertThat(counted("clockAhead")).containsEntry("", 1L);
        assertThat(counted("dead")).containsAllEntriesOf(Map.of("", 2L, "not-json", 1L, "not-an-entity", 1L));
    }

    private static List<String> warningsOf(CollectedOutput out) throws Exception {
        List<String> warnings = new CopyOnWriteArrayList<>();
        AbstractAppender recorder = new AbstractAppender("recorder", null, null, true, Property.EMPTY_ARRAY) {
            @Override
            public void append(LogEvent event) {
                warnings.add(event.getMessage().getFormattedMessage());
            }
        };
        Logger logger = (Logger) LogManager.getLogger(NormalizeNotifications.class);
        recorder.start();
        logger.addAppender(recorder);
        Configurator.setLevel(logger, Level.WARN);
        try {
            out.run();
        } finally {
            logger.removeAppender(recorder);
        }
        return warnings;
    }

    private static TopicRecord notification(String body) {
        byte[] value = body.replace('\'', '"').getBytes(UTF_8);
        return new TopicRecord("ngsi.notifications", 0, 3, RECEIVED, null, value, new HashMap<>());
    }

    /** By reason; under no name what has none. */
    private static Map<String, Long> counted(String name) {
        Map<String, Long> counts = new TreeMap<>();
        METRICS.getMetricsByGroup().forEach((group, metrics) -> {
            Metric metric = metrics.get(name);
            if (metric instanceof Counter counter) {
                counts.merge(group.getAllVariables().getOrDefault("<reason>", ""), counter.getCount(), Long::sum);
            }
        });
        return counts;
    }
}
