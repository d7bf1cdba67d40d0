package io.furrow.analytics.presence;

import java.time.Duration;
import java.util.Collection;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.functions.RichFilterFunction;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.Metric;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.awaitility.Awaitility;

import io.furrow.flink.EndOfEventTime;
import io.furrow.flink.TopicRecord;

/**
 * Holds events back until what is broadcast beside them holds event time up no more: which event is late would else depend on
 * which stream came first. Looks at the job's metrics, so it needs a {@link #cluster}.
 */
final class AfterBroadcast extends RichFilterFunction<TopicRecord> {
    private static final long serialVersionUID = 1L;
    private static final Duration PATIENCE = Duration.ofMinutes(1);

    /** Of the newest cluster: closed with its cluster, a reporter sees nothing of another. */
    private static volatile InMemoryReporter metrics;

    private final String operator;
    private final int subtasks;
    private transient boolean passed;

    /** @param operator in which both meet, by a part of its name */
    AfterBroadcast(String operator, int subtasks) {
        this.operator = operator;
        this.subtasks = subtasks;
    }

    static MiniClusterExtension cluster(int slots) {
        InMemoryReporter reporter = InMemoryReporter.create();
        metrics = reporter;
        return new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
                .setNumberTaskManagers(1)
                .setNumberSlotsPerTaskManager(slots)
                .setConfiguration(reporter.addToConfiguration(new Configuration()))
                .build());
    }

    @Override
    public boolean filter(TopicRecord record) {
        if (!passed) {
            JobID job = getRuntimeContext().getJobInfo().getJobId();
            Awaitility.await()
                    .pollInSameThread()
                    .pollDelay(Duration.ZERO)
                    .pollInterval(Duration.ofMillis(2))
                    .atMost(PATIENCE)
                    .until(() -> hasPassed(job));
            passed = true;
        }
        return true;
    }

    private boolean hasPassed(JobID job) {
        Collection<Metric> watermarks = metrics.findMetrics(job, ".*" + operator + ".*currentInput2Watermark")
                .values();
        return watermarks.size() == subtasks
                && watermarks.stream().allMatch(gauge -> EndOfEventTime.isAt((long) ((Gauge<?>) gauge).getValue()));
    }
}
