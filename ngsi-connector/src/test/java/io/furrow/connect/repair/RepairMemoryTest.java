package io.furrow.connect.repair;

import java.nio.file.Path;
import java.util.concurrent.TimeUnit;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class RepairMemoryTest {
    /** A page of 60 MiB, an entity that takes 300 MiB when it is read, 400,000 entities and as many forged subscriptions. */
    @Test
    void staysWithinItsBoundsOnASmallHeap(@TempDir Path directory) throws Exception {
        Process repair = TestProcess.java("-Xmx128m -XX:+ExitOnOutOfMemoryError", PressedRepair.class, directory)
                .redirectErrorStream(true)
                .start();
        try {
            String out = new String(repair.getInputStream().readAllBytes(), UTF_8);

            assertThat(repair.waitFor()).as(out).isZero();
            assertThat(out)
                    .contains("repaired " + PressedRepair.IMAGES + " dead 2")
                    .contains("known 0 arrived 1");
        } finally {
            repair.destroyForcibly().waitFor(10, TimeUnit.SECONDS);
        }
    }
}
