package io.furrow.soak.source;

import java.nio.file.Path;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** The short form of the soak. */
@Tag("soak")
class SourceWorkersIT {
    @Test
    void writesTheJournalsOfARemovedWorkerToKafkaOnceItsDiskIsReused(@TempDir Path folder) throws Exception {
        SourceWorkers.Outcome outcome = SourceWorkers.run(folder, 0, 100, true, PlantedFault.NONE);

        assertThat(SourceWorkers.faults(outcome, true)).isEmpty();
    }
}
