package io.furrow.flink.job;

import java.time.Duration;

import picocli.CommandLine.Option;

/** Options for the tolerated clock skew of devices and sources. */
public final class ClockOptions {
    @Option(
            names = "--clock-skew",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "How far the clock that stamps the receipt of records (header ts-source) may be ahead of this "
                            + "machine's. A later stamp counts as now plus this much, which limits how far event time is ahead. "
                            + "Replays have no receipt. Default: ${DEFAULT-VALUE}.")
    private Duration clockSkew;

    @Option(
            names = "--max-ahead",
            paramLabel = "DURATION",
            defaultValue = "1h",
            description =
                    "How far the event time of a record may be after its receipt. A record further ahead becomes a dead "
                            + "letter, from-the-future. Use the same value for all jobs. Default: ${DEFAULT-VALUE}, as in brokers.")
    private Duration maxAhead;

    @Option(
            names = "--max-behind",
            paramLabel = "DURATION",
            defaultValue = "1min",
            description =
                    "How much more the newest records of a partition may lag behind their receipt than those of another "
                            + "partition and still hold back event time. Records that lag more, of a device with a slow clock or "
                            + "one that sends stored measures, are late. Longer: such partitions hold back each other and all "
                            + "results. Default: ${DEFAULT-VALUE}.")
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
