package io.furrow.analytics.collision;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class CollisionUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        assertThat(JobUids.of(CollisionJob.assemble(options()))).isEqualTo(JobUids.checkedIn("collision"));
    }

    @Test
    void keepsThemAlsoForPredictionsAndCrossings() {
        CollisionOptions options = options("--horizon", "10s", "--crossed");

        assertThat(JobUids.of(CollisionJob.assemble(options))).isEqualTo(JobUids.checkedIn("collision-motion"));
    }

    @Test
    void keepsThemAlsoWhereClocksAreCorrected() {
        CollisionOptions options = options("--clock-correction", "on");

        assertThat(JobUids.of(CollisionJob.assemble(options))).isEqualTo(JobUids.checkedIn("collision-clocks"));
    }

    private static CollisionOptions options(String... args) {
        CollisionOptions options = new CollisionOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }
}
