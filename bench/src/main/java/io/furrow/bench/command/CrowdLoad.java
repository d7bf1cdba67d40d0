package io.furrow.bench.command;

import java.time.Duration;
import java.util.Collections;
import java.util.List;

import picocli.CommandLine.Option;

import io.furrow.bench.analytics.SustainedCrowd;
import io.furrow.bench.analytics.CrowdMeasurement;
import io.furrow.bench.analytics.Figures;
import io.furrow.bench.analytics.TopicMeasurement;

/** The part CROWD of {@link AnalyticsBench}: devices on one spot. */
final class CrowdLoad {
    private static final Duration CELL_MEASURED = Duration.ofSeconds(3);

    @Option(
            names = "--crowds",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "100,250,500,1000,2000",
            description = "Devices on one spot of CROWD; the job has the most. Default: ${DEFAULT-VALUE}.")
    private List<Integer> crowds;

    @Option(
            names = "--crowd",
            paramLabel = "N",
            defaultValue = "64",
            description = "Option of that name of CROWD's cells, beside 0. Default: ${DEFAULT-VALUE}.")
    private int crowd;

    @Option(
            names = "--crowd-others",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Devices elsewhere in CROWD, whose encounters must be exact. Default: ${DEFAULT-VALUE}.")
    private int others;

    @Option(
            names = "--crowd-seconds",
            paramLabel = "S",
            defaultValue = "300",
            description = "Seconds of each run of the job in CROWD. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    /** The cell that they share, alone. */
    boolean cells(AnalyticsFigures report) {
        Figures figures = new Figures("Devices on one spot, by processor time of the cell alone");
        for (int each : crowds) {
            for (int limit : List.of(0, crowd)) {
                report.tell("%,d devices on one spot, --crowd %d".formatted(each, limit));
                CrowdMeasurement.run(each, limit, CELL_MEASURED, figures);
            }
        }
        report.add("crowdCells", figures);
        return true;
    }

    /** The job as it is by default. */
    boolean job(TopicMeasurement measurement, int parallelism, Duration warmUp, AnalyticsFigures report)
            throws Exception {
        Figures figures = new Figures("Devices on one spot at 1 Hz beside a fleet: lag of the results");
        int most = Collections.max(crowds);
        report.tell("%,d devices on one spot beside %,d".formatted(most, others));
        SustainedCrowd held =
                measurement.crowd(new SustainedCrowd.Plan(most, warmUp, Duration.ofSeconds(seconds)), others, parallelism);
        held.overflows().forEach(report::tell);
        held.addTo(figures);
        report.add("crowd", figures);
        return held.isHeld();
    }
}
