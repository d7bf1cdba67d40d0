package io.furrow.bench.command;

import java.util.List;

import picocli.CommandLine.Option;

/** How much {@link AnalyticsBench} has to measure. */
final class AnalyticsLoad {
    @Option(
            names = "--records",
            paramLabel = "N",
            defaultValue = "1500000",
            description = "Records of each topic of KAFKA. Default: ${DEFAULT-VALUE}.")
    long records;

    @Option(
            names = "--partitions",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "4",
            description = "Partitions of each topic of KAFKA. Default: ${DEFAULT-VALUE}.")
    List<Integer> partitions;

    @Option(
            names = "--held-devices",
            paramLabel = "N",
            defaultValue = "100000",
            description = "Devices of HELD. Default: ${DEFAULT-VALUE}.")
    int heldDevices;

    @Option(
            names = "--held-sides",
            paramLabel = "M,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "2000,6300",
            description =
                    "Metres, sides of the squares in which they are; in the larger as near to each other as 10,000 in"
                            + " the smaller. Default: ${DEFAULT-VALUE}.")
    List<Double> heldSides;

    @Option(
            names = "--held-seconds",
            paramLabel = "S",
            defaultValue = "60",
            description = "Seconds for which HELD looks at the lag, at least 20. Default: ${DEFAULT-VALUE}.")
    int heldSeconds;

    @Option(
            names = "--held-ongoing",
            paramLabel = "DURATION",
            defaultValue = "10s",
            description =
                    "Option --ongoing-every of the job of HELD: 100,000 devices on four square kilometers are 98,000"
                            + " close pairs at any time. Default: ${DEFAULT-VALUE}.")
    String heldOngoing;

    @Option(
            names = "--fields",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Fields of FIELDS, of 50 vertices. Default: ${DEFAULT-VALUE}.")
    int fields;

    @Option(
            names = "--points",
            paramLabel = "N",
            defaultValue = "2000000",
            description = "Points of each round of FIELDS. Default: ${DEFAULT-VALUE}.")
    long points;
}
