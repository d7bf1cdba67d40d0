package io.furrow.flink.job;

import java.time.Duration;
import java.util.Optional;

import picocli.CommandLine.Option;

/** Options for a job's checkpoints and its restarts after a failure. Holds no Flink type, like {@link JobOptions}. */
final class RecoveryOptions {
    /** Flink's names of restart strategies. */
    public enum Restart {
        EXPONENTIAL_DELAY,
        FIXED_DELAY,
        NONE
    }

    @Option(
            names = "--checkpoint-interval",
            paramLabel = "DURATION",
            description =
                    "Time between checkpoints. Shorter: less to process again after a failure, sooner visible with "
                            + "exactly-once. Default: the cluster's, else 10s.")
    private Duration checkpointInterval;

    @Option(
            names = "--checkpoint-dir",
            paramLabel = "URI",
            description = "Where checkpoints are stored, on any Flink file system. Default: the cluster's.")
    private String checkpointDir;

    @Option(
            names = "--unaligned-checkpoints",
            description =
                    "Use unaligned checkpoints, which overtake the records between operators: they stay short under "
                            + "backpressure and contain these records.")
    private boolean unalignedCheckpoints;

    @Option(
            names = "--state-backend",
            paramLabel = "NAME",
            description =
                    "hashmap: state in memory, fastest. rocksdb: state on the task manager's disk, for more than fits in "
                            + "memory; checkpoints are incremental. With both, collision has its devices, cells, pairs and waiting "
                            + "records in memory; rocksdb then has only the copy for checkpoints. Both are in Flink's "
                            + "distribution. Default: the cluster's.")
    private String stateBackend;

    @Option(
            names = "--restart-strategy",
            paramLabel = "NAME",
            description =
                    "Restart strategy: exponential-delay, without limit, first after --restart-delay, then with a "
                            + "growing delay up to --restart-delay-max; fixed-delay, --restart-attempts times; none. Default: the "
                            + "cluster's, else exponential-delay; exponential-delay if another --restart option is given.")
    private Restart restart;

    @Option(
            names = "--restart-delay",
            paramLabel = "DURATION",
            description = "Time from a failure to the restart. Default: 1s.")
    private Duration restartDelay;

    @Option(
            names = "--restart-delay-max",
            paramLabel = "DURATION",
            description =
                    "Maximum delay of a restart. Shorter: sooner back after a long outage, more attempts during it. "
                            + "Default: 1min.")
    private Duration restartDelayMax;

    @Option(
            names = "--restart-attempts",
            paramLabel = "N",
            description = "Number of failures in a row after which the job fails finally. Default: never.")
    private Integer restartAttempts;

    /** Empty if the cluster decides. */
    Optional<Duration> checkpointInterval() {
        return Optional.ofNullable(checkpointInterval);
    }

    Optional<String> checkpointDir() {
        return Optional.ofNullable(checkpointDir);
    }

    boolean unalignedCheckpoints() {
        return unalignedCheckpoints;
    }

    Optional<String> stateBackend() {
        return Optional.ofNullable(stateBackend);
    }

    /** Whether any of the options of restarts is set: then they replace the cluster's settings completely. */
    boolean setRestarts() {
        return restart != null || restartDelay != null || restartDelayMax != null || restartAttempts != null;
    }

    Restart restart() {
        return restart == null ? Restart.EXPONENTIAL_DELAY : restart;
    }

    Duration restartDelay() {
        return restartDelay == null ? Duration.ofSeconds(1) : restartDelay;
    }

    Duration restartDelayMax() {
        return restartDelayMax == null ? Duration.ofMinutes(1) : restartDelayMax;
    }

    Optional<Integer> restartAttempts() {
        return Optional.ofNullable(restartAttempts);
    }
}
