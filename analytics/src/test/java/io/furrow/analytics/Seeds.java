package io.furrow.analytics;

import java.util.Random;
import java.util.SplittableRandom;

/** Random numbers for made-up cases, one seed after the other. */
public final class Seeds {
    private Seeds() {}

    /**
     * Neighboring seeds give {@link Random}s whose first numbers are nearly the same: of 600 worlds in a row all would have
     * as many devices. So the seed is scrambled first.
     */
    public static Random random(long seed) {
        return new Random(new SplittableRandom(seed).nextLong());
    }
}
