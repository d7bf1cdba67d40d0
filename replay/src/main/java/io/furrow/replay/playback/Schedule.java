package io.furrow.replay.playback;

import java.time.Instant;
import java.util.function.LongUnaryOperator;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/** When the events of a replay are due, and by how much they were late. Times are those of the playback's clock, ms. */
final class Schedule {
    /** What stood still for longer continues where it stood, instead of catching up, ms. */
    static final long STALL = 1_000;

    private final LongUnaryOperator wall;
    private DesiredReplay desired;
    private Timeline timeline;
    /** The next event that has been looked at for what lies before it. */
    private ReadyEvent approached;
    /** Whether the replay is in the pass of a loop that the group's clock comes to next. */
    private boolean aheadOfClock;

    private long lateness;
    /** Of the epoch, since the last restart. */
    private long slip;

    /** @param wall epoch ms at a time of the clock */
    Schedule(DesiredReplay desired, LongUnaryOperator wall) {
        this.desired = desired;
        this.wall = wall;
    }

    boolean isOfGroup() {
        return desired.clock() != null;
    }

    boolean isHeld() {
        return desired.desired() == ReplayStatus.State.PAUSED;
    }

    /** Epoch ms. */
    long wall(long now) {
        return wall.applyAsLong(now);
    }

    /**
     * From the next {@link #anchor} on by what is requested now.
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

    /** From now on the position is played at this moment, or when the replay shall start; in a group when its clock says so. */
    void anchor(long now, long position) {
        approached = null;
        long today = wall(now);
        if (isOfGroup()) {
            timeline = GroupTimeline.of(desired, now, today, aheadOfClock);
        } else {
            Long startAt = desired.plan().startAt();
            long wait = startAt == null ? 0 : Math.max(0, startAt - today);
            timeline = new Timeline(now + wait, position, desired.speed(), isHeld());
        }
    }

    long anchor() {
        return timeline.anchor();
    }

    /**
     * What lies before the next event is shortened to the longest gap.
     *
     * @param next null if it is not known
     * @param position that is reached, epoch ms
     */
    void approach(ReadyEvent next, long position) {
        Long longest = desired.plan().maxGap();
        if (next != null && next != approached && longest != null && !isHeld() && !isOfGroup()) {
            approached = next;
            long gap = next.time() - Math.max(position, timeline.origin());
            if (gap > longest) {
                timeline = timeline.skipping(gap - longest);
            }
        }
    }

    long due(ReadyEvent next) {
        return timeline.due(next.time());
    }

    /** When an epoch ends that has no more events: at once, or with the group; not while it is held, so that one can go back. */
    long endDue() {
        if (isHeld()) {
            return Timeline.NEVER;
        }
        return isOfGroup() ? timeline.due(desired.to()) : Long.MIN_VALUE;
    }

    /** Of an event that was not there in time. */
    void resumeAfterStall(ReadyEvent next, long now) {
        if (!isOfGroup() && !isHeld() && now - due(next) > STALL) {
            slip += now - due(next);
            anchor(now, next.time());
        }
    }

    void play(ReadyEvent next, long now) {
        lateness = Double.isInfinite(desired.speed()) ? 0 : now - due(next);
    }

    /** Plays an event that is due by itself. */
    void step(ReadyEvent next, long now) {
        anchor(now, next.time());
        lateness = 0;
    }

    /** Event time that is reached between these two, epoch ms. */
    long position(long now, long least, long most) {
        return timeline.at(now, least, Math.max(least, most));
    }

    /** By how much the newest event was late, ms. */
    long lateness() {
        return lateness;
    }

    /** By how much the epoch's events come later because the recording was away, ms. */
    long slip() {
        return slip;
    }

    /** What a replay waits for that shall not begin yet; null if that is over. */
    String beginsAt(long now) {
        return isHeld() || now >= anchor() ? null : "begins at " + Instant.ofEpochMilli(wall(now) + anchor() - now);
    }
}
