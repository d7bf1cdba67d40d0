package io.furrow.flink.job;

import java.time.Duration;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import org.apache.flink.api.common.ExecutionConfig;
import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.ExecutionOptions;
import org.apache.flink.configuration.ExternalizedCheckpointRetention;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.ReadableConfig;
import org.apache.flink.configuration.RestartStrategyOptions;
import org.apache.flink.configuration.StateBackendOptions;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

/** Sets checkpointing, restarts, parallelism and type rules of all jobs; see {@link JobSettings}. */
public final class JobEnvironment {
    /** The parameter of how far event time may be ahead of the clock when it is restored; ISO 8601. Absent: as far as it is. */
    public static final String MAX_RESTORED_AHEAD = "event-time.max-restored-ahead";

    /** Number of key groups; fixed forever, because state is partitioned by them. */
    private static final int MAX_PARALLELISM = 720;
    /** Short, because it is the maximum time for which a record is buffered on its way to the next subtask. */
    private static final Duration BUFFER_TIMEOUT = Duration.ofMillis(5);

    private static final Duration CHECKPOINT_INTERVAL = Duration.ofSeconds(10);
    private static final Duration PROMPT_BUFFER_TIMEOUT = Duration.ofMillis(1);
    private static final Duration PROMPT_WATERMARK_INTERVAL = Duration.ofMillis(20);

    private JobEnvironment() {}

    /** The environment of a job with its options, in a client of a cluster or in a program with its own. */
    public static StreamExecutionEnvironment create(JobOptions options) {
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment();
        JobSettings settings = settings(options, env.getConfiguration());
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, Optional.empty(), BUFFER_TIMEOUT);
        return configured(env, settings, options);
    }

    /**
     * The same for a job with a latency of milliseconds. Buffers are flushed after 1 ms; watermarks are frequent, so that the work for
     * each is small.
     */
    public static StreamExecutionEnvironment createPrompt(JobOptions options) {
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment();
        JobSettings settings = settings(options, env.getConfiguration());
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, Optional.empty(), PROMPT_BUFFER_TIMEOUT);
        settings.set(PipelineOptions.AUTO_WATERMARK_INTERVAL, Optional.empty(), PROMPT_WATERMARK_INTERVAL);
        return configured(env, settings, options);
    }

    private static StreamExecutionEnvironment configured(
            StreamExecutionEnvironment env, JobSettings settings, JobOptions options) {
        env.configure(settings.overlay());
        options.parallelism().ifPresent(env::setParallelism);
        Map<String, String> shown = new TreeMap<>(settings.origins());
        shown.putAll(options.effective());
        maxRestoredAhead(options).ifPresent(max -> shown.put(MAX_RESTORED_AHEAD, max.toString()));
        env.getConfig().setGlobalJobParameters(new EffectiveOptions(shown));
        return env;
    }

    /** Empty for replays, which may be of any time, and for jobs without event time. */
    private static Optional<Duration> maxRestoredAhead(JobOptions options) {
        Duration skew = options.clocks().clockSkew();
        return skew == null || options.inputTopics().replay().isPresent() ? Optional.empty() : Optional.of(skew);
    }

    private static JobSettings settings(JobOptions options, ReadableConfig cluster) {
        JobSettings settings = new JobSettings(cluster);
        settings.fix(PipelineOptions.AUTO_GENERATE_UIDS, false);
        settings.fix(PipelineOptions.GENERIC_TYPES, false);
        settings.fix(PipelineOptions.MAX_PARALLELISM, MAX_PARALLELISM);
        settings.set(
                PipelineOptions.NAME,
                options.isNamed() ? Optional.of(options.jobName()) : Optional.empty(),
                options.jobName());
        settings.set(PipelineOptions.OBJECT_REUSE, Optional.empty(), true);
        settings.set(CheckpointingOptions.CHECKPOINTING_INTERVAL, options.checkpointInterval(), CHECKPOINT_INTERVAL);
        TransactionTimeout.check(options, settings.get(CheckpointingOptions.CHECKPOINTING_INTERVAL));
        settings.set(
                CheckpointingOptions.EXTERNALIZED_CHECKPOINT_RETENTION,
                Optional.empty(),
                ExternalizedCheckpointRetention.RETAIN_ON_CANCELLATION);
        settings.set(CheckpointingOptions.CHECKPOINTS_DIRECTORY, options.checkpointDir());
        RecoveryOptions faults = options.faults();
        settings.set(
                CheckpointingOptions.ENABLE_UNALIGNED,
                faults.unalignedCheckpoints() ? Optional.of(true) : Optional.empty());
        settings.set(StateBackendOptions.STATE_BACKEND, faults.stateBackend());
        if (faults.stateBackend().filter("rocksdb"::equals).isPresent()) {
            settings.set(CheckpointingOptions.INCREMENTAL_CHECKPOINTS, Optional.empty(), true);
        }
        setRestarts(settings, faults);
        return settings;
    }

    /** A strategy and its parameters are set together: either by the options, or by the cluster. */
    private static void setRestarts(JobSettings settings, RecoveryOptions faults) {
        if (!faults.setRestarts() && settings.says(RestartStrategyOptions.RESTART_STRATEGY)) {
            settings.set(RestartStrategyOptions.RESTART_STRATEGY, Optional.empty());
            return;
        }
        String origin = faults.setRestarts() ? "option" : "default";
        Duration delay = faults.restartDelay();
        switch (faults.restart()) {
            case EXPONENTIAL_DELAY -> {
                settings.set(RestartStrategyOptions.RESTART_STRATEGY, "exponential-delay", origin);
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_INITIAL_BACKOFF, delay, origin);
                Duration longest = faults.restartDelayMax().compareTo(delay) < 0 ? delay : faults.restartDelayMax();
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_MAX_BACKOFF, longest, origin);
                settings.set(
                        RestartStrategyOptions.RESTART_STRATEGY_EXPONENTIAL_DELAY_ATTEMPTS,
                        faults.restartAttempts().orElse(Integer.MAX_VALUE),
                        origin);
            }
            case FIXED_DELAY -> {
                settings.set(RestartStrategyOptions.RESTART_STRATEGY, "fixed-delay", origin);
                settings.set(RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_DELAY, delay, origin);
                settings.set(
                        RestartStrategyOptions.RESTART_STRATEGY_FIXED_DELAY_ATTEMPTS,
                        faults.restartAttempts().orElse(Integer.MAX_VALUE),
                        origin);
            }
            case NONE -> settings.set(RestartStrategyOptions.RESTART_STRATEGY, "none", origin);
        }
    }

    /** The web UI shows them as the job's configuration. */
    private static final class EffectiveOptions extends ExecutionConfig.GlobalJobParameters {
        private static final long serialVersionUID = 1L;

        private final TreeMap<String, String> values;

        EffectiveOptions(Map<String, String> values) {
            this.values = new TreeMap<>(values);
        }

        @Override
        public Map<String, String> toMap() {
            return values;
        }
    }
}
