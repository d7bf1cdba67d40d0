package io.furrow.replay.source;

import java.util.ArrayDeque;
import java.util.Deque;
import java.util.Optional;
import java.util.Queue;
import java.util.concurrent.ConcurrentLinkedQueue;
import java.util.function.Consumer;

import io.furrow.flink.record.DeadLetterCounters;
import io.furrow.flink.record.TopicRecord;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.ngsi.Reason;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.replay.playback.Playback;
import io.furrow.replay.playback.PlaybackRecord;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.playback.ReadResult;
import io.furrow.replay.record.ReplayRecords;
import io.furrow.replay.recording.PageBudget;
import io.furrow.replay.recording.RecordingSources;
import io.furrow.replay.topic.ReplayTopics;
import io.furrow.replay.topic.TopicWatch;

/**
 * A replay assigned to a reader, and its playback while its desired state is readable. Used by the task's thread; only
 * answers of its {@link PageReader} come in from another.
 */
final class RunningReplay {
    /** Records before another replay's turn, statuses and ends excepted. */
    private static final int TURN = 16;

    /** Stands for the end of it among the desiredStates. */
    private static final byte[] REMOVED = {};

    private static final String DELETED = "its topic was deleted while it was played";

    private final String name;
    private final Deque<byte[]> desiredStates = new ArrayDeque<>();
    private final Queue<ReadResult> answers = new ConcurrentLinkedQueue<>();
    private final StatusReports reports;
    private final Reading reading;
    private byte[] desired;
    private PlaybackState refusedAt;
    private String refusal;
    /** Sequence of the record that cannot be read. */
    private long refused;

    private Playback playback;
    private PageReader pages;
    private long due;
    private boolean removed;
    /** Whether it is over and nothing is read for it. */
    private boolean rests;

    private final PlayedTopic topic;
    /** Whether its topic is asked for that it needs to go on after a restart. */
    private boolean asked;
    /** Whether it goes on after what its topic has. */
    private boolean goesOn;

    /**
     * What replays share.
     *
     * @param call lets the reader run a replay soon, from any thread
     */
    record Reading(
            RecordingSources recordings,
            PageBudget budget,
            ReplayTopics.Writing topics,
            TopicWatch watch,
            DeadLetterCounters dead,
            ReplayClock clock,
            Consumer<RunningReplay> call) {}

    RunningReplay(ReplaySplit split, Reading reading) {
        this.name = split.replay();
        this.reading = reading;
        this.reports = new StatusReports(name, split.state().phase().isOver());
        this.refusedAt = split.state();
        this.topic =
                new PlayedTopic(split.state(), reading, () -> reading.call().accept(this));
        this.desired = split.desired();
        take(split.desired());
        dueNow();
    }

    String name() {
        return name;
    }

    /** @param next value of the newest record of {@code service.replays}; null if it was removed */
    void update(byte[] next) {
        desiredStates.add(next == null ? REMOVED : next);
    }

    /** Begins the playback, or the next part of it; a record that this ends the epoch with is returned. */
    private Optional<PlaybackRecord> take(byte[] next) {
        long now = reading.clock().now();
        try {
            DesiredReplay replay = DesiredReplay.read(name, next);
            desired = next;
            refusal = null;
            if (playback != null) {
                return playback.apply(replay, now);
            }
            playback = new Playback(replay, refusedAt, now, reading.clock()::wall);
            pages = new PageReader(replay, () -> topic.prepare(replay.topic()), reading, answer -> {
                answers.add(answer);
                reading.call().accept(this);
            });
            return Optional.empty();
        } catch (UnreadableException e) {
            refusal = "the record of service.replays cannot be read: " + e.getMessage();
            refused = DesiredReplay.sequence(next);
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
        byte[] last = desiredStates.peekLast();
        try {
            return last == REMOVED
                    || last != null && DesiredReplay.read(name, last).desired() == ReplayStatus.State.STOPPED;
        } catch (UnreadableException e) {
            return false;
        }
    }

    private boolean isWished() {
        return desiredStates.stream().anyMatch(update -> update != REMOVED);
    }

    /** When it wants to be run, ms of the clock; {@link Long#MAX_VALUE} where something else must happen first. */
    long due() {
        return due;
    }

    void dueNow() {
        due = Math.min(due, reading.clock().now());
    }

    /** Does what is to be done by now, or a turn of it; who has more to do comes after all that are due. */
    void run(Consumer<TopicRecord> out) {
        long next = runOnce(out);
        due = Math.max(next, reading.clock().now());
    }

    private void goOnAfterItsTopic() {
        if (topic.hasRecords() && !goesOn && playback != null && topic.partitions() > 0) {
            goesOn = true;
            playback.goOnAfter(topic.end().epoch(), topic.end().timestamp());
        }
    }

    private long runOnce(Consumer<TopicRecord> out) {
        if (awaitsTopic()) {
            playback.awaitTopic(topic.refusal());
            reports.report(playback, reading.clock().now(), out);
            return reports.due(playback);
        }
        goOnAfterItsTopic();
        while (!desiredStates.isEmpty()) {
            byte[] update = desiredStates.remove();
            if (update == REMOVED) {
                remove(out);
                return Long.MAX_VALUE;
            }
            take(update).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        if (playback == null) {
            reports.reportRefused(Math.max(refused, refusedAt.sequence()), refusal, out);
            return Long.MAX_VALUE;
        }
        if (topic.wasDeleted() && !playback.isOver()) {
            playback.fail(DELETED, reading.clock().now()).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        for (ReadResult answer = answers.poll(); answer != null; answer = answers.poll()) {
            goOnAfterItsTopic(); // known before the answer came
            playback.take(answer, reading.clock().now()).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        boolean more = true;
        for (int i = 0; more && i < TURN; i++) {
            Optional<PlaybackRecord> played = playback.poll(reading.clock().now());
            playback.fetch().ifPresent(pages::read);
            played.ifPresent(one -> write(one, out));
            more = played.isPresent();
        }
        reports.report(playback, reading.clock().now(), out);
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
    private void write(PlaybackRecord playbackRecord, Consumer<TopicRecord> out) {
        reports.count(playbackRecord, playback.lateness());
        DesiredReplay replay = playback.desired();
        TopicRecord record = ReplayRecords.of(playbackRecord, replay);
        if (playbackRecord.kind() == PlaybackRecord.Kind.END) {
            for (int partition = 0; partition < topic.partitions(); partition++) {
                out.accept(record.toPartition(partition));
            }
        } else {
            if (!record.topic().equals(replay.topic())) {
                reading.dead().count(Reason.TOO_LARGE);
            }
            out.accept(record);
        }
    }

    private void remove(Consumer<TopicRecord> out) {
        if (playback != null) {
            playback.fail("nobody wants it any more", reading.clock().now())
                    .ifPresent(playbackRecord -> write(playbackRecord, out));
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

    StatusReports reports() {
        return reports;
    }

    ReplaySplit snapshot(long checkpoint) {
        if (isOver()) {
            reports.stored(checkpoint);
        }
        return new ReplaySplit(
                name,
                desired,
                playback == null ? refusedAt : playback.snapshot(reading.clock().now()));
    }

    /**
     * @param checkpoint that is complete
     * @return whether there is something to be reported therefore
     */
    boolean completed(long checkpoint) {
        return reports.completed(checkpoint);
    }

    void close() {
        if (playback != null) {
            reading.watch().remove(playback.desired().topic());
        }
        if (pages != null) {
            pages.close();
        }
    }
}
