package io.furrow.simulators.signal;

import java.time.Duration;
import java.time.Instant;
import java.time.ZoneOffset;
import java.util.OptionalDouble;

/** The curves that readings are composed of. */
public final class Curves {
    private static final int WARMEST_HOUR = 15;
    private static final double MIN_BATTERY_LEVEL = 0.2;

    private Curves() {}

    /** A cosine over each day: {@code mean + swing} at 15:00 UTC, {@code mean - swing} at 03:00 UTC. */
    public static Signal diurnal(double mean, double swing) {
        return time -> OptionalDouble.of(mean + swing * Math.cos(2 * Math.PI * (hour(time) - WARMEST_HOUR) / 24));
    }

    /** Normally distributed noise of mean 0, different in each millisecond. */
    public static Signal noise(double deviation, long seed) {
        return time -> OptionalDouble.of(
                deviation * RandomStream.of(seed, time.toEpochMilli()).nextGaussian());
    }

    /** Wanders smoothly between {@code -width} and {@code width}: drawn once per {@code pace}, a cosine in between. */
    public static Signal wandering(double width, Duration pace, long seed) {
        long step = pace.toMillis();
        return time -> {
            long number = Math.floorDiv(time.toEpochMilli(), step);
            double share = Math.floorMod(time.toEpochMilli(), step) / (double) step;
            double before = 2 * RandomStream.of(seed, number).nextDouble() - 1;
            double after = 2 * RandomStream.of(seed, number + 1).nextDouble() - 1;
            double weight = (1 - Math.cos(Math.PI * share)) / 2;
            return OptionalDouble.of(width * (before + weight * (after - before)));
        };
    }

    /**
     * The charge of a battery, falling evenly from 1 to 0.2 within {@code life}, then replaced; the phase depends on
     * the seed.
     */
    public static Signal batteryLevel(Duration life, long seed) {
        double phase = RandomStream.of(seed, 0).nextDouble();
        return time -> {
            double lives = time.toEpochMilli() / (double) life.toMillis() + phase;
            return OptionalDouble.of(1 - (1 - MIN_BATTERY_LEVEL) * (lives - Math.floor(lives)));
        };
    }

    /** Hours since midnight UTC. */
    static double hour(Instant time) {
        return time.atOffset(ZoneOffset.UTC).toLocalTime().toNanoOfDay() / 3.6e12;
    }
}
