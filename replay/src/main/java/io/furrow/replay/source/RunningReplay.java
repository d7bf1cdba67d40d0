package io.furrow.replay.source;

import java.util.ArrayDeque;
import java.util.Optional;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.Consumer;

import io.furrow.flink.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.mission.Recordings;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.WantedReplay;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.replay.ReplayRecords;
import io.furrow.replay.playback.Fetched;
import io.furrow.replay.playback.Playback;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.playback.Played;

/**
 * A replay in the hands of a reader, and its playback as long as what is wanted of it can be read. Used by the task's thread; only
 * answers of its {@link PageReader} come in from another.
 */
final class RunningReplay {
    /** Stands for the end of it among the wishes. */
    private static final byte[] REMOVED = {};

    private final String name;
    private final Queue<byte[]> wishes = new ArrayDeque<>();
    private final Queue<Fetched> answers = new ConcurrentLinkedQueue<>();
    private final StatusReports reports;
    private final Reading reading;
    private byte[] wanted;
    private PlaybackState refusedAt;
    private String refusal;
    private Playback playback;
    private PageReader pages;
    private boolean removed;
    /** Whether it is over and nothing is read for it. */
    private boolean rests;

    /** @param wakeUp lets the reader come again, from any thread */
    record Reading(Recordings recordings, PageLimits limits, Runnable wakeUp) {}

    RunningReplay(ReplaySplit split, Reading reading, long now) {
        this.name = split.replay();
        this.reading = reading;
        this.reports = new StatusReports(name, split.state().phase().isOver());
        this.refusedAt = split.state();
        this.wanted = split.wanted();
        take(split.wanted(), now);
    }

    String name() {
        return name;
    }

    /** @param next value of the newest record of {@code service.replays}; null where it was removed */
    void wish(byte[] next) {
        wishes.add(next == null ? REMOVED : next);
    }

    /** Begins the playback, or the next part of it; a record that this ends the epoch with is returned. */
    private Optional<Played> take(byte[] next, long now) {
        try {
            WantedReplay replay = WantedReplay.read(name, next);
            wanted = next;
            refusal = null;
            if (playback != null) {
                return playback.apply(replay, now);
            }
            playback = new Playback(replay, refusedAt, now);
            pages = new PageReader(replay.mission(), reading.recordings(), reading.limits(), answer -> {
                answers.add(answer);
                reading.wakeUp().run();
            });
            return Optional.empty();
        } catch (UnreadableException e) {
            refusal = "the record of service.replays cannot be read: " + e.getMessage();
            return playback == null ? Optional.empty() : playback.fail(refusal);
        }
    }

    /**
     * Does what is to be done by now.
     *
     * @param most records that are written at most, statuses and ends excepted
     * @return when it wants to be called again; not after now where more is to be done
     */
    long run(long now, int most, Consumer<TopicRecord> out) {
        for (byte[] wish = wishes.poll(); wish != null && !removed; wish = wishes.poll()) {
            if (wish == REMOVED) {
                remove(out);
                return Long.MAX_VALUE;
            }
            take(wish, now).ifPresent(played -> write(played, out));
        }
        if (playback == null) {
            reports.reportRefused(Math.max(0, refusedAt.sequence()), refusal, now, out);
            return Long.MAX_VALUE;
        }
        for (Fetched answer = answers.poll(); answer != null; answer = answers.poll()) {
            playback.take(answer, now).ifPresent(played -> write(played, out));
        }
        for (int i = 0; i < most; i++) {
            Optional<Played> played = playback.poll(now);
            playback.fetch().ifPresent(pages::read);
            if (played.isEmpty()) {
                break;
            }
            write(played.get(), out);
        }
        reports.report(playback, now, out);
        if (playback.isOver() != rests) {
            rests = playback.isOver();
            if (rests) {
                pages.rest();
            }
        }
        return Math.min(playback.due(), reports.due(playback));
    }

    private void write(Played played, Consumer<TopicRecord> out) {
        reports.count(played, playback.lateness());
        out.accept(ReplayRecords.of(played, playback.wanted()));
    }

    private void remove(Consumer<TopicRecord> out) {
        if (playback != null) {
            playback.fail("nobody wants it any more").ifPresent(played -> write(played, out));
        }
        removed = true;
    }

    /** Whether it is to be forgotten. */
    boolean isRemoved() {
        return removed;
    }

    boolean isOver() {
        return playback == null || playback.isOver();
    }

    /** Why it failed; empty where it did not. */
    Optional<String> failure() {
        if (playback == null) {
            return Optional.of(refusal);
        }
        ReplayStatus status = playback.status(0, 0, 0);
        return status.state() == ReplayStatus.State.FAILED ? Optional.of(status.reason()) : Optional.empty();
    }

    boolean isRunning() {
        return playback != null && playback.state() == ReplayStatus.State.RUNNING;
    }

    StatusReports reports() {
        return reports;
    }

    ReplaySplit snapshot(long checkpoint, long now) {
        if (isOver()) {
            reports.stored(checkpoint);
        }
        return new ReplaySplit(name, wanted, playback == null ? refusedAt : playback.snapshot(now));
    }

    /** @param checkpoint that is complete */
    void completed(long checkpoint) {
        reports.completed(checkpoint);
    }

    void close() {
        if (pages != null) {
            pages.close();
        }
    }
}
