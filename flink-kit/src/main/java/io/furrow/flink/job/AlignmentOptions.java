package io.furrow.flink.job;

import java.time.Duration;
import java.util.Optional;

import picocli.CommandLine.Option;

/** How far the partitions of a job's input may be apart. Holds no Flink type, as {@link JobOptions}. */
public final class AlignmentOptions {
    @Option(
            names = "--max-drift",
            paramLabel = "DURATION",
            description =
                    "A partition that is ahead of the slowest one by more than this event time waits, as looked at"
                            + " ten times a second. Shorter: a backlog that is read unevenly takes less memory. Longer: fewer"
                            + " waits where partitions differ by nature. 0s: none waits, as always with --idle-advance and in a replay. Default: 2min; 0s with --eager,"
                            + " of which the answers would wait, too.")
    private Duration maxDrift;

    /**
     * Empty if no partition waits for another.
     *
     * @param isPrompt whether the job answers before event time has come to a record
     */
    public Optional<Duration> maxDrift(boolean isPrompt) {
        Duration otherwise = isPrompt ? Duration.ZERO : Duration.ofMinutes(2);
        return Optional.of(maxDrift == null ? otherwise : maxDrift).filter(drift -> !drift.isZero());
    }
}
