package io.furrow.analytics;

import java.io.Serializable;
import java.util.Map;
import java.util.concurrent.TimeUnit;
import java.util.function.Supplier;

import org.apache.flink.api.common.functions.RichFilterFunction;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.runtime.testutils.InMemoryReporter;

import io.furrow.flink.record.TopicRecord;

import static org.awaitility.Awaitility.await;

/**
 * Holds records up until every subtask of an operator has heard that what is broadcast to it holds event time up no more: which
 * record is late would else depend on which of its two inputs it read first. It has where the first watermark is its event time.
 * That watermark follows a record of the time {@link #FIRST}, which goes no further.
 */
public final class AfterBroadcast extends RichFilterFunction<TopicRecord> {
    /** Before all times that a test uses, and late enough to subtract any out-of-orderness from. */
    public static final long FIRST = Long.MIN_VALUE / 2;

    private static final long serialVersionUID = 1L;

    private final String operator;
    private final int subtasks;
    private final Metrics metrics;
    private transient boolean open;

    /**
     * @param operator name of the one that joins the broadcast
     * @param subtasks its parallelism
     */
    public AfterBroadcast(String operator, int subtasks, Metrics metrics) {
        this.operator = operator;
        this.subtasks = subtasks;
        this.metrics = metrics;
    }

    /** The reporter of the test's cluster. */
    public interface Metrics extends Supplier<InMemoryReporter>, Serializable {}

    @Override
    public boolean filter(TopicRecord record) {
        if (record.timestamp() == FIRST) {
            return false;
        }
        if (!open) {
            String job = getRuntimeContext().getJobInfo().getJobId().toString();
            await().atMost(1, TimeUnit.MINUTES).until(() -> unhindered(job) == subtasks);
            open = true;
        }
        return true;
    }

    private long unhindered(String job) {
        return metrics.get().getMetricsByGroup().entrySet().stream()
                .filter(group -> {
                    Map<String, String> names = group.getKey().getAllVariables();
                    return job.equals(names.get("<job_id>")) && operator.equals(names.get("<operator_name>"));
                })
                .map(group -> group.getValue().get("currentInputWatermark"))
                .filter(metric -> metric instanceof Gauge<?> gauge && (Long) gauge.getValue() > Long.MIN_VALUE)
                .count();
    }
}
