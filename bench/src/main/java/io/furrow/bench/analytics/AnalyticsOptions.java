package io.furrow.bench.analytics;

import java.util.List;

import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;

/** The sizes of the measurements of {@link AnalyticsBench}. */
final class AnalyticsOptions {
    @Option(names = "--records", paramLabel = "N", description = "Records of each topic of KAFKA. " + Benchmark.DEFAULT)
    long records = 1_500_000;

    @Option(
            names = "--partitions",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "4",
            description = "Partitions of each topic of KAFKA. " + Benchmark.DEFAULT)
    List<Integer> partitions;

    @Option(names = "--held-devices", paramLabel = "N", description = "Devices of HELD. " + Benchmark.DEFAULT)
    int heldDevices = 100_000;

    @Option(
            names = "--held-sides",
            paramLabel = "M,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "2000,6300",
            description =
                    "Metres, sides of the squares in which they are; in the larger as near to each other as 10,000 in"
                            + " the smaller. " + Benchmark.DEFAULT)
    List<Double> heldSides;

    @Option(
            names = "--held-seconds",
            paramLabel = "S",
            description = "Seconds for which HELD looks at the lag, at least 20. " + Benchmark.DEFAULT)
    int heldSeconds = 60;

    @Option(
            names = "--held-ongoing",
            paramLabel = "DURATION",
            description =
                    "Option --ongoing-every of the job of HELD: 100,000 devices on four square kilometers are 98,000"
                            + " close pairs at any time. " + Benchmark.DEFAULT)
    String heldOngoing = "10s";

    @Option(
            names = "--crowds",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "100,250,500,1000,2000",
            description = "Devices on one spot of CROWD; the job has the most. " + Benchmark.DEFAULT)
    List<Integer> crowds;

    @Option(
            names = "--crowd",
            paramLabel = "N",
            description = "Option of that name of CROWD's cells, beside 0. " + Benchmark.DEFAULT)
    int crowd = 64;

    @Option(
            names = "--crowd-others",
            paramLabel = "N",
            description = "Devices elsewhere in CROWD, whose encounters must be exact. " + Benchmark.DEFAULT)
    int crowdOthers = 1000;

    @Option(
            names = "--crowd-seconds",
            paramLabel = "S",
            description = "Seconds of each run of the job in CROWD. " + Benchmark.DEFAULT)
    int crowdSeconds = 300;

    @Option(
            names = "--backlog-devices",
            paramLabel = "N",
            description = "Devices of BACKLOG, each of which has reported once a second. " + Benchmark.DEFAULT)
    int backlogDevices = 5000;

    @Option(names = "--backlog-seconds", paramLabel = "S", description = "For how long. " + Benchmark.DEFAULT)
    int backlogSeconds = 3600;

    @Option(
            names = "--backlog-padding",
            paramLabel = "N",
            description = "Characters by which the records of one of the two partitions are longer, so that it takes"
                    + " longer to read. " + Benchmark.DEFAULT)
    int backlogPadding = 2000;

    @Option(
            names = "--backlog-drifts",
            paramLabel = "DURATION,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1min,0s",
            description = "Option --max-drift of each run of the job; with 0s no partition waits. " + Benchmark.DEFAULT)
    List<String> backlogDrifts;

    @Option(
            names = "--fields",
            paramLabel = "N",
            description = "Fields of FIELDS, of 50 vertices. " + Benchmark.DEFAULT)
    int fields = 1000;

    @Option(
            names = "--points",
            paramLabel = "N",
            description = "Points of each round of FIELDS, reports of COVERAGE. " + Benchmark.DEFAULT)
    long points = 2_000_000;
}
