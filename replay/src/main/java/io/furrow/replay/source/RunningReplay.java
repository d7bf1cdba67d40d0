package io.furrow.replay.source;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Optional;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.Consumer;

import org.apache.flink.util.FlinkRuntimeException;

import io.furrow.flink.record.DeadCounters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.mission.PageLimits;
import io.furrow.model.control.replay.ReplayStatus;
import io.furrow.model.control.replay.WantedReplay;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.replay.ReplayRecords;
import io.furrow.replay.playback.Fetched;
import io.furrow.replay.playback.Playback;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.playback.Played;

/**
 * A replay assigned to a reader, and its playback while its desired state is readable. Used by the task's thread; only
 * answers of its {@link PageReader} come in from another.
 */
final class RunningReplay {
    /** Stands for the end of it among the wishes. */
    private static final byte[] REMOVED = {};

    private static final String DELETED = "its topic was deleted while it was played";

    private final String name;
    private final Deque<byte[]> wishes = new ArrayDeque<>();
    private final Queue<Fetched> answers = new ConcurrentLinkedQueue<>();
    private final StatusReports reports;
    private final Reading reading;
    private byte[] wanted;
    private PlaybackState refusedAt;
    private String refusal;
    /** Sequence of the record that cannot be read. */
    private long refused;

    private Playback playback;
    private PageReader pages;
    private boolean removed;
    /** Whether it is over and nothing is read for it. */
    private boolean rests;

    private final PlayedTopic topic;
    /** Whether its topic is asked for that it needs to go on after a restart. */
    private boolean asked;
    /** Whether it goes on after a restart. */
    private boolean goesOn;

    /**
     * What replays share.
     *
     * @param wakeUp lets the reader come again, from any thread
     */
    record Reading(
            RecordingSources recordings,
            PageLimits limits,
            ReplayTopics.Writing topics,
            TopicWatch watch,
            DeadCounters dead,
            Runnable wakeUp) {}

    RunningReplay(ReplaySplit split, Reading reading, long now) {
        this.name = split.replay();
        this.reading = reading;
        this.reports = new StatusReports(name, split.state().phase().isOver());
        this.refusedAt = split.state();
        this.topic = new PlayedTopic(split.state(), reading);
        this.wanted = split.wanted();
        take(split.wanted(), now);
    }

    String name() {
        return name;
    }

    /** @param next value of the newest record of {@code service.replays}; null if it was removed */
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
            playback = new Playback(replay, refusedAt, now, ReplayReader::wall);
            pages = new PageReader(
                    replay, () -> topic.prepare(replay.topic()), reading.recordings(), reading.limits(), answer -> {
                        answers.add(answer);
                        reading.wakeUp().run();
                    });
            return Optional.empty();
        } catch (UnreadableException e) {
            refusal = "the record of service.replays cannot be read: " + e.getMessage();
            refused = WantedReplay.sequence(next);
            return playback == null ? Optional.empty() : playback.refuse(refused, refusal, now);
        }
    }

    /**
     * After a restart a replay goes on only when its topic is known: what ends an epoch goes to every partition, and the next one's number
     * must be new. One that is over needs that not before it is requested again.
     */
    private boolean awaitsTopic() {
        if (!topic.isRestored()
                || playback == null
                || topic.partitions() > 0
                || playback.isOver() && !isWished()
                || topic.refusal() != null && isToEnd()) { // without a record: there is nothing that takes it
            return false;
        }
        if (!asked) {
            asked = true;
            pages.prepareSoon();
        }
        return true;
    }

    private boolean isToEnd() {
        byte[] last = wishes.peekLast();
        try {
            return last == REMOVED
                    || last != null && WantedReplay.read(name, last).wanted() == ReplayStatus.State.STOPPED;
        } catch (UnreadableException e) {
            return false;
        }
    }

    private boolean isWished() {
        return wishes.stream().anyMatch(wish -> wish != REMOVED);
    }

    /**
     * Does what is to be done by now.
     *
     * @param most records that are written at most, statuses and ends excepted
     * @return when it wants to be called again; not after now where more is to be done
     */
    long run(long now, int most, Consumer<TopicRecord> out) {
        if (awaitsTopic()) {
            playback.awaitTopic(topic.refusal());
            reports.report(playback, now, out);
            return reports.due(playback);
        }
        if (topic.isRestored() && !goesOn && playback != null && topic.partitions() > 0) {
            goesOn = true;
            playback.goOnAfter(topic.end().epoch(), topic.end().timestamp());
        }
        while (!wishes.isEmpty()) {
            byte[] wish = wishes.remove();
            if (wish == REMOVED) {
                remove(now, out);
                return Long.MAX_VALUE;
            }
            take(wish, now).ifPresent(played -> write(played, out));
        }
        if (playback == null) {
            reports.reportRefused(Math.max(refused, refusedAt.sequence()), refusal, now, out);
            return Long.MAX_VALUE;
        }
        if (topic.wasDeleted() && !playback.isOver()) {
            playback.fail(DELETED, now).ifPresent(played -> write(played, out));
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
        if (playback.rests() != rests) {
            rests = playback.rests();
            topic.setResting(rests);
            if (rests) {
                pages.rest();
            }
        }
        return Math.min(playback.due(), reports.due(playback));
    }

    /** An end goes to every partition: event time of a reader follows the slowest, so each one has to hear of it. */
    private void write(Played played, Consumer<TopicRecord> out) {
        reports.count(played, playback.lateness());
        TopicRecord record = ReplayRecords.of(played, playback.wanted());
        if (played.kind() == Played.Kind.END) {
            for (int partition = 0; partition < topic.partitions(); partition++) {
                out.accept(record.toPartition(partition));
            }
        } else {
            out.accept(writable(record));
        }
    }

    private TopicRecord writable(TopicRecord record) {
        try {
            TopicRecord taken = reading.topics().writable(record);
            if (!taken.topic().equals(record.topic())) {
                reading.dead().count(Reason.TOO_LARGE);
            }
            return taken;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            throw new FlinkRuntimeException("Interrupted while the size of a record was checked", e);
        }
    }

    private void remove(long now, Consumer<TopicRecord> out) {
        if (playback != null) {
            playback.fail("nobody wants it any more", now).ifPresent(played -> write(played, out));
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

    /** Why it failed; empty if it did not. */
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
        if (playback != null) {
            reading.watch().remove(playback.wanted().topic());
        }
        if (pages != null) {
            pages.close();
        }
    }
}
