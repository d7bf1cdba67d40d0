package io.furrow.analytics.collision;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobCommandLine;
import io.furrow.flink.JobUids;

import static org.assertj.core.api.Assertions.assertThat;

class CollisionUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        CollisionOptions options = new CollisionOptions();
        JobCommandLine.of(options).parseArgs();

        assertThat(JobUids.of(CollisionJob.assemble(options))).isEqualTo(JobUids.checkedIn("collision"));
    }
}
