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
 * A replay assigned to a reader, with its playback once its desired state is readable. Used by the task's thread; only
 * results of its {@link PageReader} arrive from another.
 */
final class RunningReplay {
    /** Maximum events and primes per turn. */
    private static final int TURN = 16;

    /** Marks the removal of the replay among its updates. */
    private static final byte[] REMOVED = {};

    private static final String DELETED = "its topic was deleted while it was played";

    private final String name;
    private final Deque<byte[]> updates = new ArrayDeque<>();
    private final Queue<ReadResult> answers = new ConcurrentLinkedQueue<>();
    private final StatusReports reports;
    private final Reading reading;
    private byte[] desired;
    private PlaybackState initialState;
    private String rejection;
    /** Sequence of the desired state that cannot be read. */
    private long rejectedSequence;

    private Playback playback;
    private PageReader pages;
    private long due;
    private boolean removed;
    /** Whether it is over and has no open request. */
    private boolean idle;

    private final PlayedTopic topic;
    /** Whether the topic's end was requested, which the replay needs after a restart. */
    private boolean preparing;
    /** Whether it continued behind the end of its topic. */
    private boolean resumed;

    /**
     * The resources that the replays of a reader share.
     *
     * @param runSoon schedules a run of a replay, from any thread
     */
    record Reading(
            RecordingSources recordings,
            PageBudget budget,
            ReplayTopics.Writing topics,
            TopicWatch watch,
            DeadLetterCounters dead,
            ReplayClock clock,
            Consumer<RunningReplay> runSoon) {}

    RunningReplay(ReplaySplit split, Reading reading) {
        this.name = split.replay();
        this.reading = reading;
        this.reports = new StatusReports(name, split.state().phase().isOver());
        this.initialState = split.state();
        this.topic =
                new PlayedTopic(split.state(), reading, () -> reading.runSoon().accept(this));
        this.desired = split.desired();
        apply(split.desired());
        dueNow();
    }

    String name() {
        return name;
    }

    /** @param next value of the newest record of {@code service.replays}; null if it was removed */
    void update(byte[] next) {
        updates.add(next == null ? REMOVED : next);
    }

    /**
     * Applies a desired state and creates the playback with the first one.
     *
     * @return the end of the epoch, if this ends one
     */
    private Optional<PlaybackRecord> apply(byte[] next) {
        long now = reading.clock().now();
        try {
            DesiredReplay replay = DesiredReplay.read(name, next);
            desired = next;
            rejection = null;
            if (playback != null) {
                return playback.apply(replay, now);
            }
            playback = new Playback(replay, initialState, now, reading.clock()::wall);
            pages = new PageReader(replay, () -> topic.prepare(replay.topic()), reading, answer -> {
                answers.add(answer);
                reading.runSoon().accept(this);
            });
            return Optional.empty();
        } catch (UnreadableException e) {
            rejection = "the record of service.replays cannot be read: " + e.getMessage();
            rejectedSequence = DesiredReplay.sequence(next);
            return playback == null ? Optional.empty() : playback.reject(rejectedSequence, rejection, now);
        }
    }

    /**
     * Returns whether the replay waits for the end of its topic, which it needs after a restart: an end record goes to
     * every partition, and the next epoch needs a new number. A replay that is over needs it only when desired again.
     */
    private boolean awaitsTopic() {
        if (!topic.isRestored()
                || playback == null
                || topic.partitions() > 0
                || playback.isOver() && !isDesiredAgain()
                || topic.problem() != null && isToStop()) { // stops without an end record, which it cannot write
            return false;
        }
        if (!preparing) {
            preparing = true;
            pages.prepareSoon();
        }
        return true;
    }

    private boolean isToStop() {
        byte[] last = updates.peekLast();
        try {
            return last == REMOVED
                    || last != null && DesiredReplay.read(name, last).desired() == ReplayStatus.State.STOPPED;
        } catch (UnreadableException e) {
            return false;
        }
    }

    private boolean isDesiredAgain() {
        return updates.stream().anyMatch(update -> update != REMOVED);
    }

    /** Returns when it is due, ms of the clock; {@link Long#MAX_VALUE} while it waits for a result or a change. */
    long due() {
        return due;
    }

    void dueNow() {
        due = Math.min(due, reading.clock().now());
    }

    /** Runs one turn; a replay with more due records runs again after all others that are due. */
    void run(Consumer<TopicRecord> out) {
        long next = runOnce(out);
        due = Math.max(next, reading.clock().now());
    }

    private void resumeAfterTopicEnd() {
        if (topic.hasRecords() && !resumed && playback != null && topic.partitions() > 0) {
            resumed = true;
            playback.resumeAfter(topic.end().epoch(), topic.end().timestamp());
        }
    }

    private long runOnce(Consumer<TopicRecord> out) {
        if (awaitsTopic()) {
            playback.awaitTopic(topic.problem());
            reports.report(playback, reading.clock().now(), out);
            return reports.due(playback);
        }
        resumeAfterTopicEnd();
        while (!updates.isEmpty()) {
            byte[] update = updates.remove();
            if (update == REMOVED) {
                remove(out);
                return Long.MAX_VALUE;
            }
            apply(update).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        if (playback == null) {
            reports.reportRejected(Math.max(rejectedSequence, initialState.sequence()), rejection, out);
            return Long.MAX_VALUE;
        }
        if (topic.wasDeleted() && !playback.isOver()) {
            playback.fail(DELETED, reading.clock().now()).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        for (ReadResult answer = answers.poll(); answer != null; answer = answers.poll()) {
            resumeAfterTopicEnd(); // the end was read before this result
            playback.accept(answer, reading.clock().now()).ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        boolean more = true;
        for (int i = 0; more && i < TURN; i++) {
            Optional<PlaybackRecord> played = playback.poll(reading.clock().now());
            playback.fetch().ifPresent(pages::read);
            played.ifPresent(one -> write(one, out));
            more = played.isPresent();
        }
        reports.report(playback, reading.clock().now(), out);
        if (playback.isIdle() != idle) {
            idle = playback.isIdle();
            topic.setIdle(idle);
            if (idle) {
                pages.suspend();
            }
        }
        return Math.min(playback.due(), reports.due(playback));
    }

    /** Writes a record; an end to every partition, because a consumer's event time follows the slowest one. */
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
            playback.fail("the replay was removed", reading.clock().now())
                    .ifPresent(playbackRecord -> write(playbackRecord, out));
        }
        removed = true;
    }

    /** Returns whether the replay was removed. */
    boolean isRemoved() {
        return removed;
    }

    boolean isOver() {
        return playback == null || playback.isOver();
    }

    /** Returns why it failed; empty if it did not. */
    Optional<String> failure() {
        if (playback == null) {
            return Optional.of(rejection);
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
                playback == null
                        ? initialState
                        : playback.snapshot(reading.clock().now()));
    }

    /**
     * Handles a completed checkpoint.
     *
     * @return whether the status has changed
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
