package io.furrow.analytics.temperature;

import java.io.Serializable;
import java.time.Duration;
import java.util.Collection;
import java.util.EnumMap;
import java.util.List;
import java.util.Map;
import java.util.function.LongUnaryOperator;
import java.util.function.Predicate;
import java.util.function.ToLongFunction;

import org.apache.flink.api.common.JobID;
import org.apache.flink.api.common.functions.OpenContext;
import org.apache.flink.api.common.functions.RichFilterFunction;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.metrics.Metric;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.awaitility.Awaitility;
import org.awaitility.core.ConditionTimeoutException;

import io.furrow.flink.TestClusters;
import io.furrow.flink.record.TopicRecord;

/**
 * Lets readings and changes of fields into the job in one order: each record waits until the job has joined the readings and
 * taken the changes that stand before it, and the watermark of the readings before it. Looks at the job's metrics, so it needs a {@link #cluster}.
 */
final class InTurn extends RichFilterFunction<TopicRecord> {
    /** Of the newest cluster: closed with its cluster, a reporter sees nothing of another. */
    private static volatile InMemoryReporter metrics;

    private static final long serialVersionUID = 1L;

    private enum Awaited {
        PASSED(1, ".*Assign readings to fields.*currentOutputWatermark"),
        JOINED(3, ".*\\.(inside|outside|repeated)"),
        TAKEN(1, ".*fieldChanges");

        private final int perSubtask;
        private final String pattern;

        Awaited(int perSubtask, String pattern) {
            this.perSubtask = perSubtask;
            this.pattern = pattern;
        }
    }

    /** What readings begin with: no reading, but a watermark that shows whether the stream of fields lets event time pass. */
    static final TopicRecord BEGIN = TopicRecord.of("", Long.MIN_VALUE + 1, "", new byte[0], Map.of());

    private final boolean isField;
    private final int subtasks;
    private final int[] before;
    private final Watermarks watermark;
    private transient Map<Awaited, Collection<Metric>> known;
    private transient int next;
    private transient int awaited;
    private transient long newest;

    /**
     * @param before of each record of the stream, how many of the other stand before it
     * @param watermark that follows a newest timestamp
     */
    private InTurn(boolean isField, int subtasks, int[] before, Watermarks watermark) {
        this.isField = isField;
        this.subtasks = subtasks;
        this.before = before;
        this.watermark = watermark;
    }

    /** Each of which waits also for the watermark that the readings before it caused. */
    static InTurn readings(int[] changesBefore, int subtasks, Watermarks watermarks) {
        return new InTurn(false, subtasks, changesBefore, watermarks);
    }

    static InTurn changes(int[] readingsBefore, int subtasks) {
        return new InTurn(true, subtasks, readingsBefore, newest -> BEGIN.timestamp());
    }

    /** The watermark that follows a newest timestamp. */
    interface Watermarks extends LongUnaryOperator, Serializable {}

    static MiniClusterExtension cluster(int slots) {
        return cluster(slots, InMemoryReporter.create());
    }

    /** Whose metrics outlive the job, and with them all that the job held. */
    static MiniClusterExtension rememberingCluster(int slots) {
        return cluster(slots, InMemoryReporter.createWithRetainedMetrics());
    }

    private static MiniClusterExtension cluster(int slots, InMemoryReporter reporter) {
        metrics = reporter;
        return TestClusters.of(slots, metrics.addToConfiguration(new Configuration()));
    }

    /** What a counter of the job has counted at all subtasks. */
    static long counted(JobID job, String counter) {
        return values(job, ".*\\." + counter).stream()
                .mapToLong(metric -> ((Counter) metric).getCount())
                .sum();
    }

    @Override
    public void open(OpenContext context) {
        known = new EnumMap<>(Awaited.class);
        newest = BEGIN.timestamp();
    }

    @Override
    public boolean filter(TopicRecord record) {
        if (record.topic().isEmpty()) {
            return false;
        }
        int needed = before[next++];
        if (!isField) {
            long due = watermark.applyAsLong(newest);
            await(Awaited.PASSED, metrics -> least(metrics, metric -> (long) ((Gauge<?>) metric).getValue()) >= due);
            newest = Math.max(newest, record.timestamp());
        }
        if (isField && needed > awaited) {
            await(
                    Awaited.JOINED,
                    metrics -> metrics.stream().mapToLong(InTurn::count).sum() >= needed);
        } else if (needed > awaited) {
            await(Awaited.TAKEN, metrics -> least(metrics, InTurn::count) >= needed);
        }
        awaited = needed;
        return true;
    }

    private static long least(Collection<Metric> metrics, ToLongFunction<Metric> value) {
        return metrics.stream().mapToLong(value).min().orElseThrow();
    }

    private static long count(Metric metric) {
        return ((Counter) metric).getCount();
    }

    /** Waits until the metrics of all subtasks are there, and then for what they shall say. */
    private void await(Awaited what, Predicate<Collection<Metric>> condition) {
        Collection<Metric> found = known.get(what);
        if (found == null) {
            JobID job = getRuntimeContext().getJobInfo().getJobId();
            until(() -> values(job, what.pattern).size() >= what.perSubtask * subtasks);
            found = values(job, what.pattern);
            known.put(what, found);
        }
        Collection<Metric> metrics = found;
        try {
            until(() -> condition.test(metrics));
        } catch (ConditionTimeoutException e) {
            JobID job = getRuntimeContext().getJobInfo().getJobId();
            throw new IllegalStateException(
                    "%s before record %d, needed %d, seen %s, of all %s"
                            .formatted(what, next, before[next - 1], told(metrics), told(values(job, what.pattern))),
                    e);
        }
    }

    private static List<Object> told(Collection<Metric> metrics) {
        return metrics.stream()
                .map(metric -> metric instanceof Counter counter ? counter.getCount() : ((Gauge<?>) metric).getValue())
                .toList();
    }

    private static Collection<Metric> values(JobID job, String pattern) {
        return metrics.findMetrics(job, pattern).values();
    }

    private static void until(java.util.concurrent.Callable<Boolean> condition) {
        Awaitility.await()
                .pollInSameThread()
                .pollDelay(Duration.ZERO)
                .pollInterval(Duration.ofMillis(2))
                .until(condition);
    }
}
