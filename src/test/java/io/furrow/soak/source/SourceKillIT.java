package io.furrow.soak.source;

import java.nio.file.Path;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

/** The short form of the soak. */
@Tag("soak")
class SourceKillIT {
    @ParameterizedTest
    @ValueSource(booleans = {true, false})
    void losesNoAcknowledgedNotificationWhenItsWorkerIsKilled(boolean exactlyOnce, @TempDir Path folder)
            throws Exception {
        SourceKill.Outcome outcome = SourceKill.run(folder, 2, 500, exactlyOnce, System.nanoTime());

        assertThat(outcome.acknowledged()).isPositive();
        assertThat(outcome.missing()).isZero();
        assertThat(outcome.repeatedWithAnotherId()).isZero();
        if (exactlyOnce) {
            assertThat(outcome.repeated()).isZero();
        }
    }
}
