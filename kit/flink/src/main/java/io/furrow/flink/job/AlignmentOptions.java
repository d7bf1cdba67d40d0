package io.furrow.flink.job;

import java.time.Duration;
import java.util.Optional;

import picocli.CommandLine.Option;

/** Options for the drift between the partitions of a job's input. Holds no Flink type, like {@link JobOptions}. */
public final class AlignmentOptions {
    @Option(
            names = "--max-drift",
            paramLabel = "DURATION",
            defaultValue = "2min",
            description =
                    "A partition that is ahead of the slowest one by more than this event time waits; checked five times "
                            + "a second. Shorter: a backlog that is read unevenly takes less memory. Longer: fewer waits if "
                            + "partitions differ. 0s: no partition waits, as always with --idle-advance and in a replay. Default: "
                            + "${DEFAULT-VALUE}.")
    private Duration maxDrift;

    /** Empty if no partition waits for another. */
    public Optional<Duration> maxDrift() {
        return Optional.of(maxDrift).filter(drift -> !drift.isZero());
    }
}
