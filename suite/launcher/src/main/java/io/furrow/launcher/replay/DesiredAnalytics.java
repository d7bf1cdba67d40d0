package io.furrow.launcher.replay;

import java.util.List;

import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/**
 * The analytics jobs that a replay requests.
 *
 * @param over whether the replay has ended and all its records are committed
 */
record DesiredAnalytics(String topic, List<ReplayAnalyticsJob> jobs, boolean over) {
    DesiredAnalytics {
        jobs = List.copyOf(jobs);
    }

    /** @param status null if there is none yet */
    static DesiredAnalytics of(DesiredReplay replay, ReplayStatus status) {
        List<ReplayAnalyticsJob> jobs = replay.plan().analytics().stream()
                .map(job -> new ReplayAnalyticsJob(job, replay.topic()))
                .toList();
        boolean over =
                status != null && status.state().isOver() && status.settled() && status.sequence() >= replay.sequence();
        return new DesiredAnalytics(replay.topic(), jobs, over);
    }

    /** The jobs of a replay that is no longer requested. */
    DesiredAnalytics ended() {
        return new DesiredAnalytics(topic, jobs, true);
    }
}
