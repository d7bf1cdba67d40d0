package io.furrow.simulators.signal;

import java.time.Instant;
import java.util.List;
import java.util.stream.IntStream;
import java.util.stream.LongStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class WeatherTest {
    private static final Instant MIDNIGHT = Instant.parse("2026-06-01T00:00:00Z");

    static Stream<Weather> places() {
        return LongStream.range(0, 30).mapToObj(seed -> new Weather(18, seed));
    }

    @ParameterizedTest
    @MethodSource("places")
    void isWarmAndDryInTheAfternoonColdAndMoistAtNight(Weather weather) {
        assertThat(at(weather.temperature(), 15)).isEqualTo(24, within(1.5));
        assertThat(at(weather.temperature(), 3)).isEqualTo(12, within(1.5));
        assertThat(at(weather.humidity(), 15)).isLessThan(at(weather.humidity(), 3) - 20);
    }

    @ParameterizedTest
    @MethodSource("places")
    void staysWithinWhatInstrumentsShow(Weather weather) {
        for (Instant time : everyMinute()) {
            assertThat(show(weather.humidity(), time)).isBetween(0d, 100d);
            assertThat(show(weather.pressure(), time)).isBetween(998d, 1029d);
            assertThat(show(weather.windSpeed(), time)).isBetween(0d, 8d);
            assertThat(show(weather.windDirection(), time))
                    .isGreaterThanOrEqualTo(0)
                    .isLessThan(360);
            assertThat(show(weather.rain(), time)).isBetween(0d, 3.2);
            assertThat(show(weather.radiation(), time)).isBetween(0d, 950d);
        }
    }

    @ParameterizedTest
    @MethodSource("places")
    void hasNoSunAtNightAndMostAtNoon(Weather weather) {
        assertThat(at(weather.radiation(), 5)).isZero();
        assertThat(at(weather.radiation(), 22)).isZero();
        assertThat(at(weather.radiation(), 12)).isGreaterThan(450);
    }

    @ParameterizedTest
    @MethodSource("places")
    void changesSlowlyWhatIsSlow(Weather weather) {
        for (Instant time : everyMinute()) {
            assertThat(show(weather.pressure(), time.plusSeconds(60)))
                    .isEqualTo(show(weather.pressure(), time), within(0.25));
        }
    }

    @Test
    void rainsNowAndThen() {
        List<Double> rain = places().flatMap(weather -> everyMinute().stream().map(time -> show(weather.rain(), time)))
                .toList();

        assertThat(rain.stream().filter(fall -> fall > 0).count() / (double) rain.size())
                .isBetween(0.01, 0.2);
    }

    @Test
    void isTheSameForTheSameSeedAndNotForAnother() {
        Signal pressure = new Weather(18, 1).pressure();

        assertThat(everyMinute().stream().map(pressure::at).toList())
                .isEqualTo(everyMinute().stream()
                        .map(new Weather(18, 1).pressure()::at)
                        .toList())
                .isNotEqualTo(everyMinute().stream()
                        .map(new Weather(18, 2).pressure()::at)
                        .toList());
    }

    private static List<Instant> everyMinute() {
        return IntStream.range(0, 24 * 60)
                .mapToObj(minute -> MIDNIGHT.plusSeconds(60L * minute))
                .toList();
    }

    private static double at(Signal signal, int hour) {
        return show(signal, MIDNIGHT.plusSeconds(3600L * hour));
    }

    private static double show(Signal signal, Instant time) {
        return signal.at(time).orElseThrow();
    }
}
