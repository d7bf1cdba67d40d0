package io.furrow.analytics.coverage;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobUids;

import static org.assertj.core.api.Assertions.assertThat;

class CoverageUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        assertThat(JobUids.of(CoverageJob.assemble(CoverageRun.options()))).isEqualTo(JobUids.checkedIn("coverage"));
    }

    @Test
    void keepsThemAlsoWhereClocksAreCorrected() {
        assertThat(JobUids.of(CoverageJob.assemble(CoverageRun.options("--clock-correction", "on"))))
                .isEqualTo(JobUids.checkedIn("coverage-clocks"));
    }
}
