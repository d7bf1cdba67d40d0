package io.furrow.analytics;

import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.CopyOnWriteArrayList;

import org.apache.flink.api.common.JobID;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Metric;
import org.apache.flink.metrics.MetricConfig;
import org.apache.flink.metrics.MetricGroup;
import org.apache.flink.metrics.reporter.MetricReporter;
import org.apache.flink.metrics.reporter.MetricReporterFactory;

/**
 * The counters of jobs, also of those that have ended. Flink's own reporter for tests keeps every metric of a job and with
 * them its operators and all that they held, which ends the memory of a test of many jobs.
 */
public final class JobCounters implements MetricReporter {
    private static final String JOB_ID = "<job_id>";
    private static final Map<String, List<Counter>> COUNTERS = new ConcurrentHashMap<>();

    /** Made by Flink, which finds it in {@code META-INF/services}. */
    public static final class Factory implements MetricReporterFactory {
        @Override
        public MetricReporter createMetricReporter(Properties properties) {
            return new JobCounters();
        }
    }

    private JobCounters() {}

    /** For a cluster whose jobs' counters are asked for. */
    public static Configuration kept() {
        Configuration settings = new Configuration();
        settings.setString("metrics.reporter.job-counters.factory.class", Factory.class.getName());
        return settings;
    }

    /**
     * The sum of a counter over all subtasks.
     *
     * @throws IllegalArgumentException where the job had none of the name
     */
    public static long total(JobID job, String counter) {
        List<Counter> found = COUNTERS.get(key(job.toString(), counter));
        if (found == null) {
            throw new IllegalArgumentException("job " + job + " had no counter " + counter);
        }
        return found.stream().mapToLong(Counter::getCount).sum();
    }

    private static String key(String job, String counter) {
        return job + '.' + counter;
    }

    @Override
    public void notifyOfAddedMetric(Metric metric, String name, MetricGroup group) {
        String job = group.getAllVariables().get(JOB_ID);
        if (metric instanceof Counter counter && job != null) {
            COUNTERS.computeIfAbsent(key(job, name), none -> new CopyOnWriteArrayList<>())
                    .add(counter);
        }
    }

    @Override
    public void notifyOfRemovedMetric(Metric metric, String name, MetricGroup group) {
        // it is asked for afterwards
    }

    @Override
    public void open(MetricConfig config) {
        // nothing to open
    }

    @Override
    public void close() {
        // nothing to close
    }
}
