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
 * @param told how far event time had come when this was last reported; {@link Long#MIN_VALUE} where it was not
 */
public record LagRun(long first, long since, long reached, int positions, long told) {
    static final int MIN = 10;
    static final long MIN_TIME = Duration.ofSeconds(30).toMillis();
    /** Between two reports of a run. */
    static final long AGAIN = Duration.ofMinutes(1).toMillis();
    /** A longer silence ends a run. */
    static final long MAX_GAP = Duration.ofMinutes(10).toMillis();

    private static final long NEVER = Long.MIN_VALUE;

    /**
     * The run with another position, which begins a new one where a position counted since the first.
     *
     * @param run null for none
     */
    static LagRun after(LagRun run, LaggingPosition position) {
        long reached = position.reached();
        if (run == null || position.counted() > run.first || run.end() < reached) {
            return new LagRun(position.time(), reached, reached, 1, NEVER);
        }
        return new LagRun(run.first, run.since, reached, run.positions + 1, run.told);
    }

    boolean isToBeTold() {
        return isToBeTold(MIN);
    }

    boolean isToBeTold(int min) {
        return positions >= min && reached - since >= MIN_TIME && (told == NEVER || reached - told >= AGAIN);
    }

    LagRun afterReport() {
        return new LagRun(first, since, reached, positions, reached);
    }

    /** The event time at which the run is over where nothing comes any more. */
    long end() {
        return reached + MAX_GAP;
    }
}
