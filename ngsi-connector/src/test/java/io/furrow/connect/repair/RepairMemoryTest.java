package io.furrow.connect.repair;

import java.nio.file.Path;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.process.TestProcess;

import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class RepairMemoryTest {
    /** A page of 60 MiB, an entity that takes 300 MiB when it is read, 400,000 entities and as many forged subscriptions. */
    @Test
    void staysWithinItsBoundsOnASmallHeap(@TempDir Path directory) throws Exception {
        TestProcess.Ended repair = TestProcess.run(
                TestProcess.java("-Xmx128m -XX:+ExitOnOutOfMemoryError", PressedRepair.class, directory));

        assertThat(repair.status()).as(repair.output()).isZero();
        assertThat(repair.output()).contains("repaired " + PressedRepair.IMAGES + " dead 2", "known 0 arrived 1");
    }
}
