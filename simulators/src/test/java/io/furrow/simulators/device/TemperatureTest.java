package io.furrow.simulators.device;

import java.time.Instant;
import java.util.stream.IntStream;

import org.junit.jupiter.api.Test;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class TemperatureTest {
    private static final Instant AFTERNOON = Instant.parse("2026-06-01T15:00:00Z");
    private static final Instant NIGHT = Instant.parse("2026-06-01T03:00:00Z");

    @Test
    void isWarmInTheAfternoonAndColdAtNight() {
        Temperature air = new Temperature.Diurnal(18, 1);

        assertThat(air.at(AFTERNOON)).isEqualTo(24, within(1.5));
        assertThat(air.at(NIGHT)).isEqualTo(12, within(1.5));
    }

    @Test
    void isTheSameForTheSameSeedAndNotForAnother() {
        assertThat(new Temperature.Diurnal(18, 1).at(NIGHT)).isEqualTo(new Temperature.Diurnal(18, 1).at(NIGHT));
        assertThat(IntStream.range(0, 20)
                        .mapToDouble(seed -> new Temperature.Diurnal(18, seed).at(NIGHT))
                        .distinct()
                        .count())
                .isGreaterThan(10);
    }

    @Test
    void changesFromSecondToSecond() {
        Temperature air = new Temperature.Diurnal(18, 1);

        assertThat(IntStream.range(0, 20)
                        .mapToDouble(second -> air.at(NIGHT.plusSeconds(second)))
                        .distinct()
                        .count())
                .isGreaterThan(10);
    }

    @Test
    void staysStuckInADefectiveThermometer() {
        assertThat(new Temperature.Stuck(60).at(NIGHT))
                .isEqualTo(60)
                .isEqualTo(new Temperature.Stuck(60).at(AFTERNOON));
    }
}
