package io.furrow.soak;

import java.nio.file.Path;
import java.time.Duration;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

/** The short form of {@code ./furrow soak bad-records}. */
@Timeout(180)
@Tag("soak")
class BadAmongGoodIT {
    @Test
    void writesEveryGoodEventOnceAndEveryBadRecordToTheDeadLetters(@TempDir Path directory) throws Exception {
        assertThat(BadRecord.all()).hasSizeGreaterThanOrEqualTo(20);
        try (BadAmongGood run = BadAmongGood.start(directory)) {
            run.write(10_000, 240);

            assertThat(run.faults(10_000, 240, Duration.ofSeconds(90))).isEmpty();
            assertThat(run.faultsAfterRedrive(10_000, 240, Duration.ofSeconds(60)))
                    .isEmpty();
        }
    }
}
