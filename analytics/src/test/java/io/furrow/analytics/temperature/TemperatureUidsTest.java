package io.furrow.analytics.temperature;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobUids;

import static org.assertj.core.api.Assertions.assertThat;

class TemperatureUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        assertThat(JobUids.of(TemperatureJob.assemble(Farm.options(Farm.FIELDS))))
                .isEqualTo(JobUids.checkedIn("temperature-file"));
    }
}
