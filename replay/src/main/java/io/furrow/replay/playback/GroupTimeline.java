package io.furrow.replay.playback;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/** Computes the schedule of a replay that follows its group's clock, which also determines the pass of a loop. */
final class GroupTimeline {
    private GroupTimeline() {}

    /**
     * Returns the schedule as of now.
     *
     * @param now ms of the clock of the schedule
     * @param epochNow epoch ms at that time
     * @param ahead whether the replay is in the pass that the group's clock enters next
     */
    static Timeline of(DesiredReplay desired, long now, long epochNow, boolean ahead) {
        DesiredReplay.Clock clock = desired.clock();
        boolean paused = desired.desired() == ReplayStatus.State.PAUSED;
        long shown = paused ? clock.shows() : clock.position(epochNow, desired.speed());
        long passedMillis = passedMillis(desired, shown, ahead);
        return new Timeline(now + clock.at() - epochNow, clock.shows() - passedMillis, desired.speed(), paused);
    }

    /** Returns the event time of the passes of a loop that the clock has completed, ms. */
    private static long passedMillis(DesiredReplay desired, long shown, boolean ahead) {
        long from = desired.from(Long.MIN_VALUE);
        long length = desired.to() - from;
        if (desired.loops() && length > 0 && shown >= desired.to()) {
            return Math.floorDiv(shown - from, length) * length;
        }
        return ahead ? length : 0;
    }

    /**
     * Returns whether the replay has begun a pass that the clock of the new command has not. A clock that is paused or
     * changed just before a pass ends does not account for the members that have begun the next one.
     */
    static boolean isAPassAhead(Timeline timeline, DesiredReplay next, long now) {
        if (next.clock() == null || !next.loops()) {
            return false;
        }
        long length = next.to() - next.from(Long.MIN_VALUE);
        return next.clock().shows() - timeline.unbounded(now) > length / 2;
    }
}
