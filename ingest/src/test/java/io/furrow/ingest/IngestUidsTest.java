package io.furrow.ingest;

import java.util.List;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.flink.JobUids;
import io.furrow.flink.job.JobCommandLine;

import static org.assertj.core.api.Assertions.assertThat;

class IngestUidsTest {
    @Test
    void keepsTheUidsThatSavepointsKnow() {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options).parseArgs("--images", "file:///images", "--mongo", "mongodb://127.0.0.1:27017");

        assertThat(JobUids.of(IngestJob.assemble(options))).isEqualTo(JobUids.checkedIn("ingest"));
    }

    @ParameterizedTest
    @CsvSource({
        "routes, route-events",
        "latest, merge-latest",
        "catalog, merge-catalog",
        "missions, write-missions",
        "images, write-images"
    })
    void givesAPartTheUidsThatItHasInTheWhole(String part, String own) {
        IngestOptions options = new IngestOptions();
        JobCommandLine.of(options)
                .parseArgs("--parts", part, "--images", "file:///images", "--mongo", "mongodb://127.0.0.1:27017");

        List<String> uids = JobUids.of(IngestJob.assemble(options));

        assertThat(JobUids.checkedIn("ingest")).containsAll(uids).hasSizeGreaterThan(uids.size());
        assertThat(uids).contains("read-events", "assign-domain-and-mission", "deduplicate-by-id", "move-images", own);
    }
}
