package io.furrow.flink;

import java.time.Duration;
import java.util.Optional;

import picocli.CommandLine.Option;

/** How a job keeps its state and comes back after a failure. Holds no Flink type, as {@link JobOptions}. */
public final class FaultOptions {
    /** What Flink calls the ways of coming back. */
    public enum Restart {
        EXPONENTIAL_DELAY,
        FIXED_DELAY,
        NONE
    }

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
                            + "does not hold, checkpoints take only what changed. Both are in Flink's distribution. Default: as the "
                            + "cluster says.")
    private String stateBackend;

    @Option(
            names = "--restart-strategy",
            paramLabel = "NAME",
            defaultValue = "exponential-delay",
            description =
                    "After a failure: exponential-delay, again and again, at first after --restart-delay, then after "
                            + "ever longer up to --restart-delay-max; fixed-delay, --restart-attempts times; none. Default: "
                            + "${DEFAULT-VALUE}.")
    private Restart restart;

    @Option(
            names = "--restart-delay",
            paramLabel = "DURATION",
            defaultValue = "1s",
            description = "Time from a failure to the restart. Default: ${DEFAULT-VALUE}.")
    private Duration restartDelay;

    @Option(
            names = "--restart-delay-max",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "The longest time to a restart. Shorter: sooner back after a long outage, more attempts during "
                            + "it. Default: ${DEFAULT-VALUE}.")
    private Duration restartDelayMax;

    @Option(
            names = "--restart-attempts",
            paramLabel = "N",
            description = "After so many failures in a row the job fails for good. Default: never.")
    private Integer restartAttempts;

    public boolean unalignedCheckpoints() {
        return unalignedCheckpoints;
    }

    public Optional<String> stateBackend() {
        return Optional.ofNullable(stateBackend);
    }

    public Restart restart() {
        return restart;
    }

    public Duration restartDelay() {
        return restartDelay;
    }

    public Duration restartDelayMax() {
        return restartDelayMax;
    }

    public Optional<Integer> restartAttempts() {
        return Optional.ofNullable(restartAttempts);
    }
}
