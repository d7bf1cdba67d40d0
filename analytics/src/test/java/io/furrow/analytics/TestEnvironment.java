package io.furrow.analytics;

import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.flink.job.JobEnvironment;
import io.furrow.flink.job.JobOptions;

/**
 * The environment of a job, but that it fails at the first exception, because restarted again and again a test would never
 * end, and without checkpoints: a barrier of one source holds up its records until the other's comes, which in a test may wait
 * for those records.
 */
public final class TestEnvironment {
    private TestEnvironment() {}

    public static StreamExecutionEnvironment of(JobOptions options) {
        StreamExecutionEnvironment env = JobEnvironment.create(options);
        Configuration failAtOnce = new Configuration();
        failAtOnce.set(RestartStrategyOptions.RESTART_STRATEGY, "none");
        env.configure(failAtOnce);
        env.getCheckpointConfig().disableCheckpointing();
        return env;
    }
}
