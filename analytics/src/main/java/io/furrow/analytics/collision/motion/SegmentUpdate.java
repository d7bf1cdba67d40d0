package io.furrow.analytics.collision.motion;

import java.util.Comparator;

import io.furrow.analytics.eventtime.HasEventTime;

/**
 * What becomes of a device's legs in one cube.
 *
 * @param cube id of the cube
 * @param time when this is known, epoch milliseconds: that of the device's newest position
 * @param leg the leg; of {@link Change#NO_LEG_AHEAD} the one that holds no more
 */
public record LegUpdate(long cube, long time, Change change, Leg leg) implements HasEventTime {
    /** What is new. */
    public enum Change {
        LEG_BEHIND,
        LEG_AHEAD,
        NO_LEG_AHEAD
    }

    static final Comparator<LegUpdate> SEQUENCE = Comparator.comparingLong(LegUpdate::time)
            .thenComparing(update -> update.leg().fix().key())
            .thenComparing(LegUpdate::change);
}
