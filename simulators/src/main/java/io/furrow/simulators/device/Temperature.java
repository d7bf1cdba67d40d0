package io.furrow.simulators.device;

import java.time.Instant;
import java.time.ZoneOffset;
import java.util.SplittableRandom;

/** What a thermometer shows at an instant, in °C with two decimals: a pure function, so a test can ask for any time. */
sealed interface Temperature {
    double at(Instant time);

    /**
     * The air over a day: warmest at 15:00 UTC, coldest at 03:00, with noise that depends on seed and time only.
     *
     * @param mean of the day, °C
     * @param seed tells devices at the same place apart: each has its own small offset and noise
     */
    record Diurnal(double mean, long seed) implements Temperature {
        private static final double SWING = 6;
        private static final double OFFSET = 0.3;
        private static final double NOISE = 0.15;

        @Override
        public double at(Instant time) {
            double hour = time.atZone(ZoneOffset.UTC).toLocalTime().toSecondOfDay() / 3600d;
            double day = mean + SWING * Math.cos(2 * Math.PI * (hour - 15) / 24);
            double offset = OFFSET * new SplittableRandom(seed).nextDouble(-1, 1);
            double noise =
                    NOISE * new SplittableRandom(seed ^ time.toEpochMilli() * 0x9E3779B97F4A7C15L).nextGaussian();
            return Math.round((day + offset + noise) * 100) / 100d;
        }
    }

    /** A defect: the same value for ever. */
    record Stuck(double celsius) implements Temperature {
        @Override
        public double at(Instant time) {
            return celsius;
        }
    }
}
