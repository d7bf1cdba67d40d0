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
            names = "--eager-devices",
            paramLabel = "N",
            defaultValue = "20000",
            description = "Devices of EAGER, each with an update a second. Default: ${DEFAULT-VALUE}.")
    int eagerDevices;

    @Option(
            names = "--buffer-timeouts",
            paramLabel = "MS,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "0,1,5",
            description =
                    "Milliseconds that records wait for company between stages of EAGER. Default: ${DEFAULT-VALUE}.")
    List<Integer> bufferTimeouts;

    @Option(
            names = "--watermark-intervals",
            paramLabel = "MS,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "20,200",
            description = "Milliseconds between watermarks of EAGER. Default: ${DEFAULT-VALUE}.")
    List<Integer> watermarkIntervals;

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
