package io.furrow.simulators.signal;

import java.util.SplittableRandom;
import java.util.random.RandomGenerator;

/** Random numbers that depend only on a seed and the number of the draw, so the order of draws is free. */
public final class RandomStream {
    private static final long GOLDEN = 0x9E3779B97F4A7C15L;

    private RandomStream() {}

    /** The random numbers of one draw. */
    public static RandomGenerator of(long seed, long number) {
        return new SplittableRandom(new SplittableRandom(seed).nextLong() + number * GOLDEN);
    }

    /** A seed derived from another, different for each name. */
    public static long seed(long seed, String name) {
        long mixed = seed;
        for (int i = 0; i < name.length(); i++) {
            mixed = new SplittableRandom(mixed + name.charAt(i)).nextLong();
        }
        return mixed;
    }
}
