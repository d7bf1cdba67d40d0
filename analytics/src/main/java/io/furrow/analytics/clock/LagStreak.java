package io.furrow.analytics.clock;

import java.time.Duration;

/**
 * A streak of late positions of a device. A device is behind after {@value #MIN} of them that came over at least 30 s of event time:
 * the backlog that a gateway sends at once is late too, but soon over.
 *
 * @param first time of the first position, epoch ms
 * @param since event time when the first arrived
 * @param reached event time when the newest arrived
 * @param positions number of positions
 * @param emitted event time of the last report; {@link Long#MIN_VALUE} before the first
 */
public record LagStreak(long first, long since, long reached, int positions, long emitted) {
    static final int MIN = 10;
    static final long MIN_TIME = Duration.ofSeconds(30).toMillis();
    /** Least event time between two reports of a streak. */
    static final long AGAIN = Duration.ofMinutes(1).toMillis();
    /** A longer silence ends a streak; devices with a battery report every hour or two. */
    static final long MAX_GAP = Duration.ofHours(3).toMillis();

    private static final long NEVER = Long.MIN_VALUE;

    /**
     * The streak with another position; a new one if a position counted since the first.
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

    /** The time after which the next report of a streak that is due is expected. */
    long interval() {
        return emitted == NEVER ? Math.max(AGAIN, (reached - since) / (positions - 1)) : reached - emitted;
    }

    LagStreak afterReport() {
        return new LagStreak(first, since, reached, positions, reached);
    }

    /** The event time at which the streak ends if no late position follows. */
    long end() {
        return reached + MAX_GAP;
    }
}
