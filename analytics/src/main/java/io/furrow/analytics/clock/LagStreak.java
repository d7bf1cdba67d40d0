package io.furrow.analytics.clock;

import java.time.Duration;

/**
 * Positions of a device that came too late in a row. A device is behind after {@value #MIN} of them that came within no less than 30 s
 * of event time: what a gateway stored and sends all at once is late too, but soon over.
 *
 * @param first the time of the first position, epoch ms
 * @param since how far event time had come with the first
 * @param reached how far with the newest
 * @param positions how many
 * @param emitted how far event time had come when this was last reported; {@link Long#MIN_VALUE} where it was not
 */
public record LagStreak(long first, long since, long reached, int positions, long emitted) {
    static final int MIN = 10;
    static final long MIN_TIME = Duration.ofSeconds(30).toMillis();
    /** Between two reports of a streak. */
    static final long AGAIN = Duration.ofMinutes(1).toMillis();
    /** A longer silence ends a streak. */
    static final long MAX_GAP = Duration.ofMinutes(10).toMillis();

    private static final long NEVER = Long.MIN_VALUE;

    /**
     * The streak with another position, which begins a new one where a position counted since the first.
     *
     * @param streak null for none
     */
    static LagStreak after(LagStreak streak, LaggingPosition position) {
        long reached = position.reached();
        if (streak == null || position.counted() > streak.first || streak.end() < reached) {
            return new LagStreak(position.time(), reached, reached, 1, NEVER);
        }
        return new LagStreak(streak.first, streak.since, reached, streak.positions + 1, streak.emitted);
    }

    boolean isDue() {
        return isDue(MIN);
    }

    boolean isDue(int min) {
        return positions >= min && reached - since >= MIN_TIME && (emitted == NEVER || reached - emitted >= AGAIN);
    }

    LagStreak afterReport() {
        return new LagStreak(first, since, reached, positions, reached);
    }

    /** The event time at which the streak is over where nothing comes any more. */
    long end() {
        return reached + MAX_GAP;
    }
}
