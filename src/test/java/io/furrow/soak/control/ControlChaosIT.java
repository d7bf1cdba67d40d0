package io.furrow.soak.control;

import java.nio.file.Path;
import java.time.Duration;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.TestReporter;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** The short form of the soak; {@code -Dfurrow.seed=N} repeats the choices of a seed. */
@Timeout(900)
@Tag("soak")
class ControlChaosIT {
    @Test
    void agreesWithAllRequestsAfterEverythingFailedOnce(TestReporter reporter, @TempDir Path folder) throws Exception {
        long seed = Long.getLong("furrow.seed", System.nanoTime());
        reporter.publishEntry("seed", Long.toString(seed));

        assertThat(ControlChaos.run(new ControlChaos.Settings(folder, Duration.ofSeconds(40), true, seed)))
                .as("seed %d", seed)
                .isEmpty();
    }
}
