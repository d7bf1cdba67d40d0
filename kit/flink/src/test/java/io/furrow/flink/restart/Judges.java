package io.furrow.flink.restart;

import java.time.Duration;
import java.util.List;
import java.util.Map;

import org.apache.flink.api.common.JobID;
import org.apache.flink.metrics.Gauge;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.awaitility.Awaitility;

/** The subtasks of a job that judge what is late, by the cluster's metrics. */
record Judges(InMemoryReporter metrics, JobID job, List<String> operators, int parallelism, long bound) {
    /** Until all of them have the watermark that follows a record of this time. */
    void await(long newest) {
        for (String operator : operators) {
            Awaitility.await()
                    .pollInSameThread()
                    .pollDelay(Duration.ZERO)
                    .pollInterval(Duration.ofMillis(1))
                    .until(() -> at(operator, newest - bound - 1) == parallelism);
        }
    }

    private long at(String operator, long watermark) {
        return metrics.getMetricsByGroup().entrySet().stream()
                .filter(group -> {
                    Map<String, String> names = group.getKey().getAllVariables();
                    return job.toString().equals(names.get("<job_id>"))
                            && operator.equals(names.get("<operator_name>"));
                })
                .map(group -> group.getValue().get("currentInputWatermark"))
                .filter(metric -> metric instanceof Gauge<?> gauge && (Long) gauge.getValue() >= watermark)
                .count();
    }
}
