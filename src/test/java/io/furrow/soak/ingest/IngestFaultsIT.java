package io.furrow.soak.ingest;

import java.nio.file.Path;
import java.util.Random;

import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** A run with faults writes the same topics, collections and files as a run without; long form: {@code ingest-kill}. */
@Timeout(300)
@Tag("soak")
class IngestFaultsIT {
    private static final int RECORDS = 9_000;
    private static final int PER_SECOND = 1_500;
    private static final int KILLS = 3;
    /**
     * All folder names have the same length, because the catalog counts the bytes of events, which contain the location
     * of images.
     */
    private static final String FAULTLESS = "faultless";

    @TempDir
    static Path directory;

    private static IngestOutcome faultless;

    @BeforeAll
    static void runWithoutFaults() throws Exception {
        try (FarmRun run = FarmRun.start(directory.resolve(FAULTLESS), RECORDS, 0)) {
            run.startJob(2, null);
            faultless = run.outcome();
        }
        assertThat(faultless.lines().keySet())
                .contains("topic data.farm.realtime", "topic data.latest", "topic data.catalog", "topic data.raw.dead")
                .contains("topic data.farm.realtime.weeding", "topic data.farm.realtime.spraying")
                .contains("collection mission_weeding", "collection mission_sowing", "collection mission_spraying");
        assertThat(faultless.size("images"))
                .isEqualTo(faultless.size("topic data.images"))
                .isPositive();
        assertThat(faultless.size("topic data.farm.realtime")).isGreaterThan(RECORDS / 2);
        assertThat(faultless.size("transactions left open")).isZero();
    }

    @Test
    void writesTheSameIfItsTaskManagerIsKilledUnderLoad() throws Exception {
        long seed = System.nanoTime();
        System.out.println("seed " + seed);
        int[] moments = new Random(seed)
                .ints(KILLS, RECORDS / 10, RECORDS * 9 / 10)
                .sorted()
                .toArray();
        try (FarmRun run = FarmRun.start(directory.resolve("killed-it"), RECORDS, PER_SECOND)) {
            run.startJob(2, null);
            run.awaitWritten(moments[0]);
            run.replaceTaskManager(); // possibly before the first checkpoint
            for (int i = 1; i < KILLS; i++) {
                run.awaitCheckpoint();
                run.awaitWritten(moments[i]);
                run.replaceTaskManager();
            }
            run.awaitCheckpoint();
            assertThat(run.restored()).isGreaterThanOrEqualTo(KILLS - 1L);

            assertThat(run.outcome().differencesTo(faultless)).isEmpty();
        }
    }

    @Test
    void writesTheSameIfItContinuesFromSavepointsAtOtherParallelisms() throws Exception {
        try (FarmRun run = FarmRun.start(directory.resolve("resumed-1"), RECORDS, PER_SECOND)) {
            run.startJob(1, null);
            run.awaitWritten(RECORDS / 3);
            run.startJob(3, run.stopJob());
            run.awaitWritten(RECORDS * 2 / 3);
            run.startJob(2, run.stopJob());

            assertThat(run.outcome().differencesTo(faultless)).isEmpty();
        }
    }
}
