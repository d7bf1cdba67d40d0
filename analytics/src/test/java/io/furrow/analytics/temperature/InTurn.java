package io.furrow.analytics.temperature;

import java.time.Duration;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.function.ToLongFunction;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.functions.RichFilterFunction;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.Metric;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;

import io.furrow.flink.TopicRecord;

import static org.awaitility.Awaitility.await;

/**
 * Lets readings and changes of fields into the job in one order: each record waits until the job has joined the readings and
 * taken the changes that stand before it. Looks at the job's metrics, so it needs a {@link #cluster}.
 */
final class InTurn extends RichFilterFunction<TopicRecord> {
    static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();
    private static final long serialVersionUID = 1L;
    /** What readings begin with: no reading, but a watermark that shows whether the stream of fields lets event time pass. */
    static final TopicRecord BEGIN = TopicRecord.of("", Long.MIN_VALUE + 1, "", new byte[0], Map.of());

    private final boolean isField;
    private final int subtasks;
    private final int[] before;
    private transient int next;
    private transient int awaited;

    /** @param before of each record of the stream, how many of the other stand before it */
    private InTurn(boolean isField, int subtasks, int[] before) {
        this.isField = isField;
        this.subtasks = subtasks;
        this.before = before;
    }

    static InTurn readings(int[] changesBefore, int subtasks) {
        return new InTurn(false, subtasks, changesBefore);
    }

    static InTurn changes(int[] readingsBefore, int subtasks) {
        return new InTurn(true, subtasks, readingsBefore);
    }

    static MiniClusterExtension cluster(int slots) {
        return new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
                .setNumberTaskManagers(1)
                .setNumberSlotsPerTaskManager(slots)
                .setConfiguration(METRICS.addToConfiguration(new Configuration()))
                .build());
    }

    /** What a counter of the job has counted at all subtasks. */
    static long counted(JobID job, String counter) {
        return values(job, ".*\\." + counter).stream()
                .mapToLong(metric -> ((Counter) metric).getCount())
                .sum();
    }

    @Override
    public boolean filter(TopicRecord record) {
        if (record.topic().isEmpty()) {
            return false;
        }
        JobID job = getRuntimeContext().getJobInfo().getJobId();
        int needed = before[next++];
        if (isField && needed > awaited) {
            until(() -> counted(job, "inside") + counted(job, "outside") + counted(job, "repeated") >= needed);
        } else if (!isField && next == 1) {
            String passed = ".*Assign readings to fields.*currentOutputWatermark";
            until(() -> all(job, passed, metric -> (long) ((Gauge<?>) metric).getValue(), BEGIN.timestamp()));
        }
        if (!isField && needed > awaited) {
            until(() -> all(job, ".*field-changes", metric -> ((Counter) metric).getCount(), needed));
        }
        awaited = needed;
        return true;
    }

    private boolean all(JobID job, String pattern, ToLongFunction<Metric> value, long least) {
        List<Metric> metrics = values(job, pattern).stream()
                .filter(metric -> value.applyAsLong(metric) >= least)
                .toList();
        return metrics.size() >= subtasks;
    }

    private static Collection<Metric> values(JobID job, String pattern) {
        return METRICS.findMetrics(job, pattern).values();
    }

    private static void until(java.util.concurrent.Callable<Boolean> condition) {
        await().pollInSameThread()
                .pollDelay(Duration.ZERO)
                .pollInterval(Duration.ofMillis(2))
                .atMost(Duration.ofSeconds(30))
                .until(condition);
    }
}
