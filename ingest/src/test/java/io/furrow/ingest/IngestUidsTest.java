package io.furrow.ingest;

import org.junit.jupiter.api.Test;

import io.furrow.flink.JobCommandLine;
import io.furrow.flink.JobUids;

import static org.assertj.core.api.Assertions.assertThat;

class IngestUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs("--images", "file:///images", "--mongo", "mongodb://127.0.0.1:27017");

        assertThat(JobUids.of(IngestJob.assemble(options))).isEqualTo(JobUids.checkedIn("ingest"));
    }
}
