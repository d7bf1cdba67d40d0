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
 * Reports the status of a replay: twice a second while it runs, not all replays at once, and on each change. A replay that is over is reported
 * again, as settled, when a checkpoint holds that it is over: whoever forgets it then will not see it come back.
 */
final class StatusReports {
    private static final int INTERVAL_MILLIS = 500;
    private static final long NONE = -1;
    private static final double MILLIS = 1_000;

    private final String replay;
    /** Of its ticks, ms. */
    private final int phase;
    /** Read by metrics, too. */
    private volatile ReplayStatus told;

    private long reportedAt;
    private long tick;
    private long events;
    private long worst;
    private long lateness;
    private double rate;
    private long storedIn = NONE;
    private boolean settled;

    /** @param settled whether the state from which it continues is that of a replay that is over */
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

    /** Number of the state that was reported last; −1 where none was. */
    int state() {
        ReplayStatus last = told;
        return last == null ? -1 : last.state().ordinal();
    }

    /** Event time that was reported last, epoch ms; 0 where none was. */
    long position() {
        ReplayStatus last = told;
        return last == null || last.progress() == null ? 0 : last.progress().position();
    }

    /** By how much the latest event since the last report was behind its schedule, ms. */
    long lateness() {
        return Math.max(lateness, worst);
    }

    /** By how much the epoch's schedule was moved when it was last reported, ms; 0 where none was. */
    long slip() {
        ReplayStatus last = told;
        return last == null || last.progress() == null ? 0 : last.progress().slipMillis();
    }

    /** Events per second, until the last report. */
    double rate() {
        return rate;
    }

    /** @param checkpoint that will hold that the replay is over */
    void stored(long checkpoint) {
        if (storedIn == NONE) {
            storedIn = checkpoint;
        }
    }

    /** @return whether that settles it */
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
        if (told == null || now >= due(playback) || hasChanged(playback, now)) {
            long millis = Math.max(1, told == null ? INTERVAL_MILLIS : now - reportedAt);
            rate = Math.round(events * MILLIS / millis * 10) / 10.0;
            lateness = worst;
            write(playback.status(now, worst, rate), out);
            reportedAt = now;
            tick = tickAfter(now);
            events = 0;
            worst = 0;
        }
    }

    /** At least half an interval later, so that rates are of a time that counts. */
    private long tickAfter(long now) {
        long half = now + INTERVAL_MILLIS / 2;
        return half + INTERVAL_MILLIS - Math.floorMod(half - phase, INTERVAL_MILLIS);
    }

    private boolean hasChanged(Playback playback, long now) {
        return told.sequence() != playback.sequence()
                || told.state() != playback.state()
                || told.settled() != (settled && playback.isOver())
                || told.progress() == null
                || told.progress().epoch() != playback.epoch()
                || !Objects.equals(told.progress().waiting(), playback.awaited(now));
    }

    /** Of a replay of which it cannot be read what is requested. */
    void reportRefused(long sequence, String reason, Consumer<TopicRecord> out) {
        if (told == null || told.settled() != settled || told.sequence() != sequence || !reason.equals(told.reason())) {
            write(new ReplayStatus(sequence, ReplayStatus.State.FAILED, reason, false, null), out);
        }
    }

    private void write(ReplayStatus status, Consumer<TopicRecord> out) {
        told = new ReplayStatus(
                status.sequence(),
                status.state(),
                status.reason(),
                settled && status.state().isOver(),
                status.progress());
        out.accept(TopicRecord.of(Topics.REPLAYS_STATUS, System.currentTimeMillis(), replay, told.toBytes(), Map.of()));
    }

    /** When the next report is due, unless something changes before. */
    long due(Playback playback) {
        boolean moves = playback.state() == ReplayStatus.State.RUNNING || playback.isSeeking() || events > 0;
        return moves ? tick : Long.MAX_VALUE;
    }
}
