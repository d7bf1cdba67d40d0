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

    public Duration clockSkew() {
        return clockSkew;
    }

    public Duration maxAhead() {
        return maxAhead;
    }
}
