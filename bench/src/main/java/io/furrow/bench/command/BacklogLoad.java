package io.furrow.bench.command;

import java.util.List;

import picocli.CommandLine.Option;

import io.furrow.bench.analytics.Backlog;
import io.furrow.bench.analytics.Figures;
import io.furrow.bench.analytics.TopicMeasurement;

/** The part BACKLOG of {@link AnalyticsBench}: a job that was unavailable. */
final class BacklogLoad {
    @Option(
            names = "--backlog-devices",
            paramLabel = "N",
            defaultValue = "5000",
            description = "Devices of BACKLOG, each of which has reported once a second. Default: ${DEFAULT-VALUE}.")
    private int devices;

    @Option(
            names = "--backlog-seconds",
            paramLabel = "S",
            defaultValue = "3600",
            description = "For how long. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    @Option(
            names = "--backlog-padding",
            paramLabel = "N",
            defaultValue = "2000",
            description = "Characters by which the records of one of the two partitions are longer, so that it takes"
                    + " longer to read. Default: ${DEFAULT-VALUE}.")
    private int padding;

    @Option(
            names = "--backlog-drifts",
            paramLabel = "DURATION,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1min,0s",
            description = "Option --max-drift of each run of the job; with 0s no partition waits. Default:"
                    + " ${DEFAULT-VALUE}.")
    private List<String> maxDrifts;

    boolean run(TopicMeasurement measurement, AnalyticsFigures report) throws Exception {
        Figures figures = new Figures("A job that catches up with two partitions, one of them slower to read");
        for (String maxDrift : maxDrifts) {
            report.tell("%,d s of %,d devices, --max-drift %s".formatted(seconds, devices, maxDrift));
            measurement.backlog(new Backlog(devices, seconds, padding, maxDrift), figures);
        }
        report.add("backlog", figures);
        return true;
    }
}
