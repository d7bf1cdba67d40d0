package io.furrow.flink;

import java.time.Duration;
import java.util.Map;

import org.apache.flink.api.common.ExecutionConfig;
import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.ExecutionOptions;
import org.apache.flink.configuration.ExternalizedCheckpointRetention;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.configuration.StateBackendOptions;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

/** The one place that sets checkpointing, restarts, parallelism and type rules of a job. */
public final class JobEnvironment {
    /** Key groups; fixed for ever, because state is kept by them. */
    private static final int MAX_PARALLELISM = 720;
    /** Kept short: a record waits at most this long for company on its way to the next subtask. */
    private static final Duration BUFFER_TIMEOUT = Duration.ofMillis(5);

    private static final Duration PROMPT_BUFFER_TIMEOUT = Duration.ofMillis(1);
    private static final Duration PROMPT_WATERMARK_INTERVAL = Duration.ofMillis(20);

    private JobEnvironment() {}

    public static StreamExecutionEnvironment create(JobOptions options) {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.NAME, options.jobName());
        settings.set(PipelineOptions.AUTO_GENERATE_UIDS, false);
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        settings.set(PipelineOptions.MAX_PARALLELISM, MAX_PARALLELISM);
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, BUFFER_TIMEOUT);
        settings.set(CheckpointingOptions.CHECKPOINTING_INTERVAL, options.checkpointInterval());
        settings.set(
                CheckpointingOptions.EXTERNALIZED_CHECKPOINT_RETENTION,
                ExternalizedCheckpointRetention.RETAIN_ON_CANCELLATION);
        options.checkpointDir().ifPresent(dir -> settings.set(CheckpointingOptions.CHECKPOINTS_DIRECTORY, dir));
        if (options.faults().unalignedCheckpoints()) { // else as the cluster says
            settings.set(CheckpointingOptions.ENABLE_UNALIGNED, true);
        }
        options.faults().stateBackend().ifPresent(name -> settings.set(StateBackendOptions.STATE_BACKEND, name));
        if (options.faults().stateBackend().filter("rocksdb"::equals).isPresent()) {
            settings.set(CheckpointingOptions.INCREMENTAL_CHECKPOINTS, true);
        }
        setRestarts(settings, options.faults());

        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        options.parallelism().ifPresent(env::setParallelism);
        env.getConfig().setGlobalJobParameters(new EffectiveOptions(options.effective()));
        return env;
    }

    /**
     * For a job whose answers are wanted in milliseconds. Buffers go on after 1 ms; watermarks come often, so that what each
     * brings about holds up little.
     */
    public static void hasten(StreamExecutionEnvironment env) {
        Configuration settings = new Configuration();
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, PROMPT_BUFFER_TIMEOUT);
        settings.set(PipelineOptions.AUTO_WATERMARK_INTERVAL, PROMPT_WATERMARK_INTERVAL);
        env.configure(settings);
    }

    private static void setRestarts(Configuration settings, FaultOptions faults) {
        Duration delay = faults.restartDelay();
        switch (faults.restart()) {
            case EXPONENTIAL_DELAY -> {
                settings.set(RestartStrategyOptions.RESTART_STRATEGY, "exponential-delay");
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_INITIAL_BACKOFF, delay);
                Duration longest = faults.restartDelayMax().compareTo(delay) < 0 ? delay : faults.restartDelayMax();
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_MAX_BACKOFF, longest);
                faults.restartAttempts()
                        .ifPresent(attempts -> settings.set(
                                RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_ATTEMPTS, attempts));
            }
            case FIXED_DELAY -> {
                settings.set(RestartStrategyOptions.RESTART_STRATEGY, "fixed-delay");
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_DELAY, delay);
                settings.set(
                        RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_ATTEMPTS,
                        faults.restartAttempts().orElse(Integer.MAX_VALUE));
            }
            case NONE -> settings.set(RestartStrategyOptions.RESTART_STRATEGY, "none");
        }
    }

    /** Shown by the web UI under the job's configuration. */
    private static final class EffectiveOptions extends ExecutionConfig.GlobalJobParameters {
        private static final long serialVersionUID = 1L;

        private final java.util.TreeMap<String, String> values;

        EffectiveOptions(Map<String, String> values) {
            this.values = new java.util.TreeMap<>(values);
        }

        @Override
        public Map<String, String> toMap() {
            return values;
        }
    }
}
