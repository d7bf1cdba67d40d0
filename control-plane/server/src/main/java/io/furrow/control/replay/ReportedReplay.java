package io.furrow.control.replay;

import io.furrow.model.control.ReplayStatus;

/**
 * The last report of a replay, without the members that change while it runs.
 *
 * @param sequence of the desired state that was applied last
 * @param first event time of the recording's first event, epoch ms; null if not reported yet
 * @param last event time of the recording's last known event, epoch ms; null if unknown
 * @param ended when its final end was reported, epoch ms; null if it was not
 */
record ReportedReplay(String replay, long sequence, ReplayStatus.State state, Long first, Long last, Long ended) {

    /** @param before null if there is no previous report @param now epoch ms */
    static ReportedReplay of(String replay, ReplayStatus report, ReportedReplay before, long now) {
        ReplayStatus.Progress progress = report.progress();
        boolean hasExtent = progress != null && progress.to() > 0;
        boolean atEnd = report.state() == ReplayStatus.State.ENDED && report.settled();
        boolean repeated = before != null && before.ended != null && before.sequence == report.sequence();
        return new ReportedReplay(
                replay,
                report.sequence(),
                report.state(),
                hasExtent ? Long.valueOf(progress.from()) : before == null ? null : before.first,
                hasExtent
                        ? Long.valueOf(Math.max(progress.to(), progress.position()))
                        : before == null ? null : before.last,
                !atEnd ? null : repeated ? before.ended : Long.valueOf(now));
    }

    /** Whether the desired state was applied and the replay is over. @param desired sequence of the desired state */
    boolean isOver(long desired) {
        return state.isOver() && sequence >= desired;
    }
}
