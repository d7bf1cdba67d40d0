package io.furrow.replay.playback;

import io.furrow.model.control.ReplayCommand;

/**
 * Absolute schedule between two changes of speed: an event of time t is due at anchor + (t − origin) / speed, rounded up to
 * milliseconds, so that nothing drifts. Stands still while it is held.
 *
 * @param anchor time of the clock at which the origin is played, ms
 * @param origin event time, epoch ms
 * @param speed {@link ReplayCommand#MAX} makes everything due at the anchor
 */
record Timeline(long anchor, long origin, double speed, boolean held) {
    static final long NEVER = Long.MAX_VALUE;

    long due(long time) {
        return held ? NEVER : anchor + (long) Math.ceil((time - origin) / speed);
    }

    /** The event time that is played at a time of the clock, between these two. */
    long at(long now, long least, long most) {
        double reached = origin;
        if (!held && now > anchor) {
            reached = speed == ReplayCommand.MAX ? most : origin + Math.floor((now - anchor) * speed);
        }
        return (long) Math.max(least, Math.min(most, reached));
    }

    /** The event time that is played at a time of the clock, wherever that is. */
    long unbounded(long now) {
        return held || now <= anchor ? origin : origin + (long) Math.floor((now - anchor) * speed);
    }

    /** The same, ahead by a stretch of event time, ms. */
    Timeline skipping(long stretch) {
        return new Timeline(anchor, origin + stretch, speed, held);
    }
}
