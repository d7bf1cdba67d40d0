package io.furrow.simulators.signal;

import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.OptionalDouble;
import java.util.SplittableRandom;
import java.util.stream.IntStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.MethodSource;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.assertj.core.api.Assertions.within;

/** Each rule on a hundred devices of random seeds, readings at random times. */
class SensorFaultTest {
    private static final long SEED = 20261121;
    private static final Instant START = Instant.parse("2026-06-01T00:00:00Z");
    private static final Duration DAY = Duration.ofDays(1);
    private static final TimeWindow NOON =
            new TimeWindow(START.plus(Duration.ofHours(11)), START.plus(Duration.ofHours(13)));

    /** A device and the times at which it is asked. */
    record Case(long seed, Signal sound, List<Instant> times) {
        @Override
        public String toString() {
            return "seed " + seed;
        }
    }

    static Stream<Case> cases() {
        return new SplittableRandom(SEED).longs(100).mapToObj(seed -> {
            SplittableRandom random = new SplittableRandom(seed);
            Signal sound = Curves.diurnal(18, 6).plus(Curves.noise(0.15, seed)).rounded(2);
            List<Instant> times = random.longs(200, 0, DAY.toMillis())
                    .mapToObj(START::plusMillis)
                    .toList();
            return new Case(seed, sound, times);
        });
    }

    @ParameterizedTest
    @MethodSource("cases")
    void leavesASensorSoundOutsideItsTime(Case device) {
        for (SensorFault fault : List.of(
                new SensorFault.Stuck(NOON, 60d),
                new SensorFault.Drift(NOON, 3),
                new SensorFault.Spikes(NOON, 1, 20, device.seed),
                new SensorFault.Silent(NOON))) {
            for (Instant time : device.times) {
                if (!NOON.holds(time)) {
                    assertThat(fault.on(device.sound).at(time)).isEqualTo(device.sound.at(time));
                } else {
                    assertThat(fault.on(device.sound).at(time)).isNotEqualTo(device.sound.at(time));
                }
            }
        }
    }

    @ParameterizedTest
    @MethodSource("cases")
    void repeatsWhatAStuckSensorShowedWhenItGotStuck(Case device) {
        Signal stuck = new SensorFault.Stuck(new TimeWindow(START, null), null).on(device.sound);

        assertThat(device.times).allSatisfy(time -> assertThat(stuck.at(time)).isEqualTo(device.sound.at(START)));
    }

    @ParameterizedTest
    @MethodSource("cases")
    void driftsAtItsRate(Case device) {
        double perHour = 1 + device.seed % 5;
        Signal drifting = new SensorFault.Drift(new TimeWindow(START, null), perHour).on(device.sound);

        for (Instant time : device.times) {
            double off = drifting.at(time).getAsDouble() - device.sound.at(time).getAsDouble();
            double hours = Duration.between(START, time).toMillis() / 3.6e6;
            assertThat(off).isEqualTo(perHour * hours, within(1e-9));
        }
    }

    @ParameterizedTest
    @MethodSource("cases")
    void isOffByItsHeightInItsShareOfTheReadings(Case device) {
        Signal spiky = new SensorFault.Spikes(new TimeWindow(START, null), 0.1, 20, device.seed).on(device.sound);

        List<Double> off = IntStream.range(0, 2000)
                .mapToObj(START::plusSeconds)
                .map(time ->
                        spiky.at(time).getAsDouble() - device.sound.at(time).getAsDouble())
                .filter(by -> Math.abs(by) > 1e-9)
                .toList();

        // 200 wanted; four standard deviations are 54.
        assertThat(off)
                .hasSizeBetween(146, 254)
                .allSatisfy(by -> assertThat(Math.abs(by)).isEqualTo(20, within(1e-9)));
        assertThat(off).anyMatch(by -> by > 0).anyMatch(by -> by < 0);
    }

    @ParameterizedTest
    @MethodSource("cases")
    void reportsNothingWhileSilent(Case device) {
        Signal silent = new SensorFault.Silent(new TimeWindow(START, null)).on(device.sound);

        assertThat(device.times).allSatisfy(time -> assertThat(silent.at(time)).isEqualTo(OptionalDouble.empty()));
    }

    @ParameterizedTest
    @MethodSource("cases")
    void showsTheSameForTheSameSeedInAnyOrder(Case device) {
        Signal again =
                Curves.diurnal(18, 6).plus(Curves.noise(0.15, device.seed)).rounded(2);
        Signal other =
                Curves.diurnal(18, 6).plus(Curves.noise(0.15, device.seed + 1)).rounded(2);

        assertThat(device.times.stream().sorted().map(again::at))
                .containsExactlyElementsOf(
                        device.times.stream().sorted().map(device.sound::at).toList());
        assertThat(device.times.stream().map(device.sound::at).toList())
                .isEqualTo(device.times.stream().map(again::at).toList());
        assertThat(device.times.stream().filter(time -> !other.at(time).equals(device.sound.at(time))))
                .hasSizeGreaterThan(150);
    }

    @Test
    void rejectsAShareThatIsNone() {
        assertThatThrownBy(() -> new SensorFault.Spikes(NOON, 1.5, 20, 1))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessage("the share of spikes is 0 to 1, not 1.5");
    }

    @Test
    void endsASpanBeforeItsEnd() {
        assertThat(NOON.holds(NOON.from())).isTrue();
        assertThat(NOON.holds(NOON.until())).isFalse();
        assertThatThrownBy(() -> new TimeWindow(NOON.until(), NOON.from()))
                .isInstanceOf(IllegalArgumentException.class);
    }
}
