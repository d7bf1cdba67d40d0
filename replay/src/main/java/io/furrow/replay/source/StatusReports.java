package io.furrow.replay.source;

import java.util.Map;
import java.util.Objects;
import java.util.function.Consumer;

import io.furrow.flink.record.TopicRecord;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.topic.Topics;
import io.furrow.replay.playback.Playback;
import io.furrow.replay.playback.PlaybackRecord;

/**
 * Reports the status of a replay on each change, and every 500 ms while it runs, at a different phase for each replay.
 * When a checkpoint contains the end of a replay, its status is reported again as settled: the replay then cannot
 * return after a restart.
 */
final class StatusReports {
    private static final int INTERVAL_MILLIS = 500;
    private static final long NONE = -1;
    private static final double MILLIS = 1_000;

    private final String replay;
    /** Phase of its reports, ms. */
    private final int phase;
    /** The last status; metrics read it, too. */
    private volatile ReplayStatus reported;

    private long reportedAt;
    private long tick;
    private long events;
    private long worst;
    private long lateness;
    private double rate;
    private long storedIn = NONE;
    private boolean settled;

    /** @param settled whether the restored state is that of a replay that is over */
    StatusReports(String replay, boolean settled) {
        this.replay = replay;
        this.phase = Math.floorMod(replay.hashCode(), INTERVAL_MILLIS);
        this.settled = settled;
    }

    void count(PlaybackRecord playbackRecord, long late) {
        if (playbackRecord.kind() == PlaybackRecord.Kind.EVENT) {
            events++;
            worst = Math.max(worst, late);
        }
    }

    /** Returns the ordinal of the last reported state; −1 before the first report. */
    int state() {
        ReplayStatus last = reported;
        return last == null ? -1 : last.state().ordinal();
    }

    /** Returns the last reported event time, epoch ms; 0 before the first report. */
    long position() {
        ReplayStatus last = reported;
        return last == null || last.progress() == null ? 0 : last.progress().position();
    }

    /** Returns the maximum lateness since the report before the last, ms. */
    long lateness() {
        return Math.max(lateness, worst);
    }

    /** Returns the last reported delay of the epoch's schedule, ms; 0 before the first report. */
    long slip() {
        ReplayStatus last = reported;
        return last == null || last.progress() == null ? 0 : last.progress().slipMillis();
    }

    /** Returns the events per second before the last report. */
    double rate() {
        return rate;
    }

    /** @param checkpoint that will contain the end of the replay */
    void stored(long checkpoint) {
        if (storedIn == NONE) {
            storedIn = checkpoint;
        }
    }

    /** @return whether the end of the replay is now settled */
    boolean completed(long checkpoint) {
        boolean settles = !settled && storedIn != NONE && checkpoint >= storedIn;
        settled |= settles;
        return settles;
    }

    void report(Playback playback, long now, Consumer<TopicRecord> out) {
        if (!playback.isOver()) {
            storedIn = NONE;
            settled = false;
        }
        if (reported == null || now >= due(playback) || hasChanged(playback, now)) {
            long millis = Math.max(1, reported == null ? INTERVAL_MILLIS : now - reportedAt);
            rate = Math.round(events * MILLIS / millis * 10) / 10.0;
            lateness = worst;
            write(playback.status(now, worst, rate), out);
            reportedAt = now;
            tick = tickAfter(now);
            events = 0;
            worst = 0;
        }
    }

    /** Returns the next report, at least half an interval later, so that rates cover enough time. */
    private long tickAfter(long now) {
        long half = now + INTERVAL_MILLIS / 2;
        return half + INTERVAL_MILLIS - Math.floorMod(half - phase, INTERVAL_MILLIS);
    }

    private boolean hasChanged(Playback playback, long now) {
        return reported.sequence() != playback.sequence()
                || reported.state() != playback.state()
                || reported.settled() != (settled && playback.isOver())
                || reported.progress() == null
                || reported.progress().epoch() != playback.epoch()
                || !Objects.equals(reported.progress().waiting(), playback.awaited(now));
    }

    /** Reports a replay whose desired state cannot be read. */
    void reportRejected(long sequence, String reason, Consumer<TopicRecord> out) {
        if (reported == null
                || reported.settled() != settled
                || reported.sequence() != sequence
                || !reason.equals(reported.reason())) {
            write(new ReplayStatus(sequence, ReplayStatus.State.FAILED, reason, false, null), out);
        }
    }

    private void write(ReplayStatus status, Consumer<TopicRecord> out) {
        reported = new ReplayStatus(
                status.sequence(),
                status.state(),
                status.reason(),
                settled && status.state().isOver(),
                status.progress());
        out.accept(TopicRecord.of(
                Topics.REPLAYS_STATUS, System.currentTimeMillis(), replay, reported.toBytes(), Map.of()));
    }

    /** Returns when the next report is due without a change. */
    long due(Playback playback) {
        boolean moves = playback.state() == ReplayStatus.State.RUNNING || playback.isSeeking() || events > 0;
        return moves ? tick : Long.MAX_VALUE;
    }
}
