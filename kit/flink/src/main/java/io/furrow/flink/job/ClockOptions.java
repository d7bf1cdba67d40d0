package io.furrow.flink.job;

import java.time.Duration;

import picocli.CommandLine.Option;

/** How far a job believes the clocks of those that report to it. */
public final class ClockOptions {
    @Option(
            names = "--clock-skew",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "How far the clock of the part that stamps the receipt of records (header ts-source) may be ahead of"
                            + " this one. A later stamp counts as now and this much; so event time is ahead of the clock by no"
                            + " more. Of replays there is no receipt. Default: ${DEFAULT-VALUE}.")
    private Duration clockSkew;

    @Option(
            names = "--max-ahead",
            paramLabel = "DURATION",
            defaultValue = "1h",
            description =
                    "How far the event time of a record may be after its receipt. A record further ahead becomes a"
                            + " dead letter, from-the-future. Give all jobs the same. Default: ${DEFAULT-VALUE}, as brokers have it.")
    private Duration maxAhead;

    @Option(
            names = "--max-behind",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "How much further the newest records of a partition may be behind their receipt than those of another"
                            + " partition and still hold up event time. Those further behind, of a device whose clock is slow or"
                            + " that sends what it stored, are late. Longer: partitions that differ so much wait for each other, and so do"
                            + " all results. Default: ${DEFAULT-VALUE}.")
    private Duration maxBehind;

    public Duration clockSkew() {
        return clockSkew;
    }

    public Duration maxAhead() {
        return maxAhead;
    }

    public Duration maxBehind() {
        return maxBehind;
    }
}
