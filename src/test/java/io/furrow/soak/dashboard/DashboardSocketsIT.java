package io.furrow.soak.dashboard;

import java.nio.file.Path;
import java.time.Duration;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** The short form of the soak. */
@Timeout(600)
@Tag("soak")
class DashboardSocketsIT {
    @Test
    void servesAllSocketsInTimeAndReleasesAllResources(@TempDir Path folder) throws Exception {
        assertThat(DashboardSockets.run(new DashboardSockets.Settings(
                        folder, Duration.ofSeconds(10), 40, 6, 200, 150, Duration.ofSeconds(1))))
                .isEmpty();
    }
}
