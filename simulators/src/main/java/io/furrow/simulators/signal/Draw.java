package io.furrow.simulators.signal;

import java.util.SplittableRandom;
import java.util.random.RandomGenerator;

/** Random numbers that depend on a seed and a number of the draw only, so that none has to be drawn before another. */
public final class Draw {
    private static final long GOLDEN = 0x9E3779B97F4A7C15L;

    private Draw() {}

    /** The random numbers of one draw. */
    public static RandomGenerator of(long seed, long number) {
        return new SplittableRandom(new SplittableRandom(seed).nextLong() + number * GOLDEN);
    }

    /** A seed for a part of that which {@code seed} is for: another for each name. */
    public static long seed(long seed, String name) {
        long mixed = seed;
        for (int i = 0; i < name.length(); i++) {
            mixed = new SplittableRandom(mixed + name.charAt(i)).nextLong();
        }
        return mixed;
    }
}
