package io.furrow.flink.job;

import java.time.Duration;
import java.util.Optional;

import picocli.CommandLine.Option;

/** How a job keeps its state and comes back after a failure. Holds no Flink type, as {@link JobOptions}. */
final class RecoveryOptions {
    /** What Flink calls the ways of coming back. */
    public enum Restart {
        EXPONENTIAL_DELAY,
        FIXED_DELAY,
        NONE
    }

    @Option(
            names = "--checkpoint-interval",
            paramLabel = "DURATION",
            description = "Time between checkpoints. Shorter: less to repeat after a failure, sooner visible with "
                    + "exactly-once. Default: as the cluster says, else 10s.")
    private Duration checkpointInterval;

    @Option(
            names = "--checkpoint-dir",
            paramLabel = "URI",
            description = "Where checkpoints are kept, on any Flink file system. Default: as the cluster says.")
    private String checkpointDir;

    @Option(
            names = "--unaligned-checkpoints",
            description = "Let checkpoints overtake records that wait between operators: they stay short under "
                    + "back-pressure, and grow by what waits.")
    private boolean unalignedCheckpoints;

    @Option(
            names = "--state-backend",
            paramLabel = "NAME",
            description =
                    "hashmap: state in memory, fastest; rocksdb: on the task manager's disk, for state that memory "
                            + "does not hold, checkpoints take only what changed. With both, collision holds in memory what its"
                            + " devices, cells and pairs are at and what waits for event time; rocksdb has only the copy that"
                            + " checkpoints are made of. Both are in Flink's distribution. Default: as the cluster says.")
    private String stateBackend;

    @Option(
            names = "--restart-strategy",
            paramLabel = "NAME",
            description =
                    "After a failure: exponential-delay, again and again, at first after --restart-delay, then after "
                            + "ever longer up to --restart-delay-max; fixed-delay, --restart-attempts times; none. Default: "
                            + "as the cluster says, else exponential-delay; exponential-delay where another --restart "
                            + "option is given.")
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
                    "The longest time to a restart. Shorter: sooner back after a long outage, more attempts during "
                            + "it. Default: 1min.")
    private Duration restartDelayMax;

    @Option(
            names = "--restart-attempts",
            paramLabel = "N",
            description = "After so many failures in a row the job fails for good. Default: never.")
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

    /** Whether any of the options of restarts was given: then they, and not the cluster, say all of it. */
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
