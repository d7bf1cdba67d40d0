package io.furrow.fiware.agent;

import java.time.Clock;
import java.time.Instant;
import java.time.ZoneOffset;

import org.junit.jupiter.api.Test;

import io.furrow.fiware.agent.MeasureHistory.Ignored;
import io.furrow.fiware.agent.MeasureHistory.Received;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

class MeasureHistoryTest {
    private final MeasureHistory history = new MeasureHistory(Clock.fixed(Instant.ofEpochMilli(1000), ZoneOffset.UTC));

    @Test
    void remembersTheLastMeasureAndTheBeginningOfWhatCouldNotBeRead() {
        history.measured("key", "d");
        history.unreadable("key", "d", "{".getBytes(UTF_8), "no JSON");
        history.unreadable("key", "d", "x".repeat(5000).getBytes(UTF_8), "no JSON either");

        assertThat(history.of("key", "d"))
                .contains(new Received(1000L, new Ignored(2, 1000, "no JSON either", "x".repeat(200))));
    }

    @Test
    void forgetsStrangersAndNeverADevice() {
        history.measured("key", "d");
        for (int i = 0; i < 5000; i++) {
            history.unknown("key-" + i, "stranger", new byte[0], "unknown");
        }
        history.unknown("k".repeat(60_000), "stranger", new byte[0], "unknown");

        assertThat(history.of("key", "d")).isPresent();
        assertThat(history.of("key-4999", "stranger")).isPresent();
        assertThat(history.of("key-3999", "stranger")).isEmpty();
        assertThat(history.of("k".repeat(60_000), "stranger")).isEmpty();
    }
}
