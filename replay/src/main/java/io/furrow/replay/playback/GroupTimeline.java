package io.furrow.replay.playback;

import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/** The schedule of a replay whose group has a clock; the passes of a loop are counted from that clock. */
final class GroupTimeline {
    private GroupTimeline() {}

    /**
     * @param now ms of the clock of the schedule
     * @param today epoch ms at that time
     * @param ahead whether the replay is in the pass that the group's clock comes to next
     */
    static Timeline of(DesiredReplay desired, long now, long today, boolean ahead) {
        DesiredReplay.Clock clock = desired.clock();
        boolean held = desired.desired() == ReplayStatus.State.PAUSED;
        long shown = held ? clock.shows() : clock.position(today, desired.speed());
        long passed = passed(desired, shown, ahead);
        return new Timeline(now + clock.at() - today, clock.shows() - passed, desired.speed(), held);
    }

    /** Event time of the passes of a loop that the clock has left behind, ms. */
    private static long passed(DesiredReplay desired, long shown, boolean ahead) {
        long from = desired.from(Long.MIN_VALUE);
        long length = desired.to() - from;
        if (desired.loops() && length > 0 && shown >= desired.to()) {
            return Math.floorDiv(shown - from, length) * length;
        }
        return ahead ? length : 0;
    }

    /** A clock that was stopped or changed just before a pass of its loop ends does not know who has begun the next. */
    static boolean isAPassAhead(Timeline timeline, DesiredReplay next, long now) {
        if (next.clock() == null || !next.loops()) {
            return false;
        }
        long length = next.to() - next.from(Long.MIN_VALUE);
        return next.clock().shows() - timeline.unbounded(now) > length / 2;
    }
}
