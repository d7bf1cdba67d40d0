package io.furrow.control.replay;

import io.furrow.model.control.ReplayStatus;

/**
 * What was reported last of a replay, without what changes as long as it runs.
 *
 * @param sequence of the desired replay that was applied last
 * @param first event time of the recording's first event, epoch ms; null if it was not reported yet
 * @param last event time of the last event that is known of the recording, epoch ms; null if none is
 * @param ended when it was reported for good that it had come to its end, epoch ms; null if it was not
 */
record ReportedReplay(String replay, long sequence, ReplayStatus.State state, Long first, Long last, Long ended) {

    /** @param before null if nothing was reported before @param now epoch ms */
    static ReportedReplay of(String replay, ReplayStatus report, ReportedReplay before, long now) {
        ReplayStatus.Progress progress = report.progress();
        boolean spans = progress != null && progress.to() > 0;
        boolean atEnd = report.state() == ReplayStatus.State.ENDED && report.settled();
        boolean again = before != null && before.ended != null && before.sequence == report.sequence();
        return new ReportedReplay(
                replay,
                report.sequence(),
                report.state(),
                spans ? Long.valueOf(progress.from()) : before == null ? null : before.first,
                spans
                        ? Long.valueOf(Math.max(progress.to(), progress.position()))
                        : before == null ? null : before.last,
                !atEnd ? null : again ? before.ended : Long.valueOf(now));
    }

    /** Whether nothing more will come of what is desired by now. @param desired its sequence */
    boolean isOver(long desired) {
        return state.isOver() && sequence >= desired;
    }
}
