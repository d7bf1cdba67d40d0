package io.furrow.analytics.collision;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.entry;

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

    /** Flink restores no state whose key is of another version. */
    @Test
    void keepsTheFormatsOfItsKeys() throws Exception {
        CollisionOptions options = options("--horizon", "10s", "--crossed", "--dwell", "1s");

        assertThat(JobUids.keyFormats(CollisionJob.assemble(options)))
                .containsOnly(
                        entry("io.furrow.analytics.position.DeviceSerializer", 1),
                        entry("io.furrow.analytics.collision.encounter.PairSerializer", 1));
    }

    private static CollisionOptions options(String... args) {
        CollisionOptions options = new CollisionOptions();
        JobCommandLine.of(options).parseArgs(args);
        return options;
    }
}
