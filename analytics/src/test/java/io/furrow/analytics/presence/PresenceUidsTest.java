package io.furrow.analytics.presence;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class PresenceUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        PresenceOptions options = new PresenceOptions();
        JobCommandLine.of(options).parseArgs();

        assertThat(JobUids.of(PresenceJob.assemble(options))).isEqualTo(JobUids.checkedIn("presence"));
    }

    @Test
    void keepsThemAlsoWhereClocksAreCorrected() {
        PresenceOptions options = new PresenceOptions();
        JobCommandLine.of(options).parseArgs("--clock-correction", "on");

        assertThat(JobUids.of(PresenceJob.assemble(options))).isEqualTo(JobUids.checkedIn("presence-clocks"));
    }
}
