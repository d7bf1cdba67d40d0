package io.furrow.bench.ingest;

import java.util.List;

import org.junit.jupiter.api.Test;

import io.furrow.flink.job.Delivery;

import static org.assertj.core.api.Assertions.assertThat;

class IngestReportTest {
    private static final IngestReport.Plan PLAN = new IngestReport.Plan(1000, 4, 1000, 10, 2, 2, 5_000);

    @Test
    void comparesTheRunsOfOneTurn() {
        IngestReport report = new IngestReport(
                PLAN,
                List.of(
                        run(ComparedJob.COPY_TWICE, 1, 100, 0),
                        run(ComparedJob.ROUTES, 1, 70, 0),
                        run(ComparedJob.COPY_TWICE, 2, 10, 0), // something else took the machine for this turn
                        run(ComparedJob.ROUTES, 2, 6, 0),
                        run(ComparedJob.COPY_TWICE, 3, 120, 0),
                        run(ComparedJob.ROUTES, 3, 60, 0)));

        assertThat(report.median(Delivery.AT_LEAST_ONCE, ComparedJob.ROUTES)).isEqualTo(60);
        assertThat(report.ratio(Delivery.AT_LEAST_ONCE, ComparedJob.ROUTES, ComparedJob.COPY_TWICE))
                .isEqualTo(0.6);
        assertThat(report.ratio(Delivery.AT_LEAST_ONCE, ComparedJob.ROUTES, ComparedJob.COPY_ONCE))
                .isNaN();
        assertThat(report.isComplete()).isTrue();
    }

    @Test
    void isNotCompleteWhereOneRunLostARecordAndAnotherWroteOneTwice() {
        IngestReport report =
                new IngestReport(PLAN, List.of(run(ComparedJob.ROUTES, 1, 1, 1), run(ComparedJob.ROUTES, 2, 1, -1)));

        assertThat(report.isComplete()).isFalse();
    }

    private static IngestReport.Run run(ComparedJob peer, int turn, double perSecond, long missing) {
        return new IngestReport.Run(peer, Delivery.AT_LEAST_ONCE, turn, perSecond, 1e6 / perSecond, 0, missing);
    }
}
