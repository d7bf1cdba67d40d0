package io.furrow.launcher.process;

import java.time.Duration;

import org.junit.jupiter.api.Test;

import io.furrow.cli.option.CommandException;

import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ClockWatchTest {
    private long wall = 1_700_000_000_000L;
    private long nanos = Long.MAX_VALUE - 5;
    private final ClockWatch clock = new ClockWatch(() -> wall, () -> nanos);

    @Test
    void acceptsAClockThatGoesOnOrIsSetForwardOrSlightlyBack() {
        pass(60_000, 60_000);
        pass(7_200_000, 1_000);
        pass(-8_000, 1_000);
        pass(-8_000, 1_000);
    }

    @Test
    void rejectsAClockThatIsSetBack() {
        pass(60_000, 60_000);
        wall -= 3_599_000;
        nanos += Duration.ofSeconds(1).toNanos();
        assertThatThrownBy(clock::check)
                .isInstanceOf(CommandException.class)
                .hasMessageStartingWith("The clock was set back by 3600 s");
    }

    private void pass(long wallMillis, long millis) {
        wall += wallMillis;
        nanos += Duration.ofMillis(millis).toNanos();
        clock.check();
    }
}
