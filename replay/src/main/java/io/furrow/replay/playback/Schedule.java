package io.furrow.replay.playback;

import java.time.Instant;
import java.util.function.LongUnaryOperator;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/** Computes when the events of a replay are due and how late they were. Times are those of the playback's clock, ms. */
final class Schedule {
    /** A replay that was stalled for longer continues at its position instead of catching up, ms. */
    static final long STALL = 1_000;

    private final LongUnaryOperator wall;
    private DesiredReplay desired;
    private Timeline timeline;
    /** The next event, if the gap before it was compared with the maximum. */
    private ReadyEvent shortenedBefore;
    /** Whether the replay is in the pass of a loop that the group's clock enters next. */
    private boolean aheadOfClock;

    private long lateness;
    /** Delay of the epoch's schedule since the last restart. */
    private long slip;

    /** @param wall epoch ms at a time of the clock */
    Schedule(DesiredReplay desired, LongUnaryOperator wall) {
        this.desired = desired;
        this.wall = wall;
    }

    boolean isOfGroup() {
        return desired.clock() != null;
    }

    boolean isPaused() {
        return desired.desired() == ReplayStatus.State.PAUSED;
    }

    /** Returns the epoch ms at a time of the clock. */
    long wall(long now) {
        return wall.applyAsLong(now);
    }

    /**
     * Follows this desired state from the next {@link #anchor} on.
     *
     * @param plays whether an epoch is being played
     */
    void follow(DesiredReplay next, boolean plays, long now) {
        aheadOfClock = isOfGroup() && plays && GroupTimeline.isAPassAhead(timeline, next, now);
        desired = next;
    }

    void beginEpoch() {
        aheadOfClock = false;
        slip = 0;
    }

    /** Schedules the position for now, or for the requested start; in a group for the time that its clock defines. */
    void anchor(long now, long position) {
        shortenedBefore = null;
        long epochNow = wall(now);
        if (isOfGroup()) {
            timeline = GroupTimeline.of(desired, now, epochNow, aheadOfClock);
        } else {
            Long startAt = desired.plan().startAt();
            long wait = startAt == null ? 0 : Math.max(0, startAt - epochNow);
            timeline = new Timeline(now + wait, position, desired.speed(), isPaused());
        }
    }

    long anchor() {
        return timeline.anchor();
    }

    /**
     * Shortens the gap before the next event to the maximum.
     *
     * @param next null if it is not read yet
     * @param position reached event time, epoch ms
     */
    void shortenGap(ReadyEvent next, long position) {
        Long maxGap = desired.plan().maxGap();
        if (next != null && next != shortenedBefore && maxGap != null && !isPaused() && !isOfGroup()) {
            shortenedBefore = next;
            long gap = next.time() - Math.max(position, timeline.origin());
            if (gap > maxGap) {
                timeline = timeline.skipping(gap - maxGap);
            }
        }
    }

    long due(ReadyEvent next) {
        return timeline.due(next.time());
    }

    /** Returns when an epoch without further events ends: at once, with the group, or not while paused. */
    long endDue() {
        if (isPaused()) {
            return Timeline.NEVER;
        }
        return isOfGroup() ? timeline.due(desired.to()) : Long.MIN_VALUE;
    }

    /** Moves the schedule if the event was read too late. */
    void resumeAfterStall(ReadyEvent next, long now) {
        if (!isOfGroup() && !isPaused() && now - due(next) > STALL) {
            slip += now - due(next);
            anchor(now, next.time());
        }
    }

    void play(ReadyEvent next, long now) {
        lateness = Double.isInfinite(desired.speed()) ? 0 : now - due(next);
    }

    /** Plays an event as a single step. */
    void step(ReadyEvent next, long now) {
        anchor(now, next.time());
        lateness = 0;
    }

    /** Returns the reached event time within these bounds, epoch ms. */
    long position(long now, long min, long max) {
        return timeline.at(now, min, Math.max(min, max));
    }

    /** Returns the delay of the newest event, ms. */
    long lateness() {
        return lateness;
    }

    /** Returns the delay of the epoch's schedule because the recording was unavailable, ms. */
    long slip() {
        return slip;
    }

    /** Returns the start for which a replay waits; null if it has begun or is paused. */
    String beginsAt(long now) {
        return isPaused() || now >= anchor() ? null : "begins at " + Instant.ofEpochMilli(wall(now) + anchor() - now);
    }
}
