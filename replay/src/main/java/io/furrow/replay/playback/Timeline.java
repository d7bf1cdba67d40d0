package io.furrow.replay.playback;

import io.furrow.model.control.ReplayCommand;

/**
 * An absolute schedule between two changes of speed: an event of time t is due at anchor + (t − origin) / speed,
 * rounded up to milliseconds, so that rounding errors do not add up.
 *
 * @param anchor time of the clock at which the origin is played, ms
 * @param origin event time, epoch ms
 * @param speed {@link ReplayCommand#MAX} makes every event due at the anchor
 * @param paused whether the position stays at the origin
 */
record Timeline(long anchor, long origin, double speed, boolean paused) {
    static final long NEVER = Long.MAX_VALUE;

    long due(long time) {
        return paused ? NEVER : anchor + (long) Math.ceil((time - origin) / speed);
    }

    /** Returns the event time at a time of the clock, within these bounds. */
    long at(long now, long min, long max) {
        double reached = origin;
        if (!paused && now > anchor) {
            reached = speed == ReplayCommand.MAX ? max : origin + Math.floor((now - anchor) * speed);
        }
        return (long) Math.max(min, Math.min(max, reached));
    }

    /** Returns the event time at a time of the clock, without bounds. */
    long unbounded(long now) {
        return paused || now <= anchor ? origin : origin + (long) Math.floor((now - anchor) * speed);
    }

    /** Returns the same schedule, ahead by an interval of event time, ms. */
    Timeline skipping(long millis) {
        return new Timeline(anchor, origin + millis, speed, paused);
    }
}
