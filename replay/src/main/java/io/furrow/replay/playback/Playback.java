package io.furrow.replay.playback;

import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.function.LongUnaryOperator;

import io.furrow.flink.record.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayPlan;
import io.furrow.model.control.ReplayStatus;
import io.furrow.replay.playback.PlaybackState.Phase;

/**
 * Plays one recording as the desired state requests. The caller passes the time, in ms of a clock that never steps
 * back, reads the requests of {@link #fetch} and writes each returned record at once. Each start, seek, step back and
 * pass of a loop is an epoch: the states before its point, then events, then an end.
 *
 * <p>A replay of a group follows the group's clock: it neither waits for a slow recording nor ends before the group
 * does.
 */
public final class Playback {
    /** Minimum duration of a pass of a loop, ms, because the number of epochs is limited. */
    static final long MIN_PASS = 1_000;

    private static final String NO_EPOCH_LEFT = "all " + (Epochs.LAST + 1) + " epochs are used; start another replay";

    private final Schedule schedule;
    private DesiredReplay desired;
    private final PlaybackState at;
    private ReadAhead ahead;

    /** Greatest epoch on the topic after a restart. */
    private long usedEpoch;
    /** Greatest timestamp on the topic after a restart. */
    private long usedStamp;
    /** Whether no checkpoint contained the replay. */
    private final boolean isNew;

    private String waiting;
    private long passBegan;

    /**
     * @param desired the desired state that was applied last; of a new replay the first one
     * @param wall epoch ms at a time of the clock
     */
    public Playback(DesiredReplay desired, PlaybackState state, long now, LongUnaryOperator wall) {
        this.desired = desired;
        this.schedule = new Schedule(desired, wall);
        this.at = state.copy();
        boolean fresh = at.sequence < 0;
        this.isNew = fresh;
        this.passBegan = fresh ? now : now - MIN_PASS;
        at.sequence = desired.sequence();
        if (fresh) {
            at.start = desired.seek() == null
                    ? at.start
                    : Long.valueOf(desired.seek().to());
            steps().dropObsolete();
        }
        if (fresh && isStopped()) {
            at.enter(Phase.STOPPED, null);
        } else if (at.epoch > Epochs.LAST) {
            at.enter(Phase.FAILED, NO_EPOCH_LEFT);
        }
        startOver(now);
    }

    private void startOver(long now) {
        schedule.anchor(now, at.position);
        ahead = new ReadAhead(at.cursor);
        waiting = null;
    }

    /**
     * Continues behind records that the topic has but the restored state does not: their epochs are not used again, and
     * the timestamps of later epochs are not less than theirs.
     *
     * @param epoch greatest epoch on the topic
     * @param stamp greatest timestamp on the topic, epoch ms
     */
    public void resumeAfter(long epoch, long stamp) {
        usedEpoch = epoch;
        usedStamp = stamp;
        waiting = null;
        if (isNew && at.phase == Phase.OPENING && at.epoch <= epoch) {
            begin(at.start, passBegan);
        } else if (isNew && at.phase == Phase.OPENING) {
            at.stamp = Math.max(at.stamp, stamp);
        }
    }

    private PendingSteps steps() {
        return new PendingSteps(at, desired);
    }

    private boolean isStopped() {
        return desired.desired() == ReplayStatus.State.STOPPED;
    }

    /**
     * Applies a desired state unless it is older than the last one.
     *
     * @return the end of the epoch, if this ends one
     */
    public Optional<PlaybackRecord> apply(DesiredReplay next, long now) {
        if (next.sequence() <= at.sequence) {
            return Optional.empty();
        }
        boolean seeks = next.seek() != null && next.seek().sequence() > at.sequence;
        boolean leavesRange = at.phase == Phase.BETWEEN && desired.range() != null && next.range() == null;
        long position = position(now);
        long rangeEnd = desired.to();
        schedule.follow(next, at.phase == Phase.PLAYING, now);
        desired = next;
        at.sequence = next.sequence();
        steps().dropObsolete();
        at.goal = schedule.isPaused() ? at.goal : null;
        schedule.anchor(now, position);
        if (isStopped()) {
            return finish(Phase.STOPPED, null, "stopped", now);
        }
        if (!seeks && leavesRange) { // plays on behind the range
            begin(schedule.isOfGroup() ? desired.clock().position(schedule.wall(now), desired.speed()) : rangeEnd, now);
        }
        if (!seeks) {
            return Optional.empty();
        }
        Optional<PlaybackRecord> end = end("seek", now);
        begin(next.seek().to(), now);
        return end;
    }

    /** Ends the replay with a failure. */
    public Optional<PlaybackRecord> fail(String reason, long now) {
        return finish(Phase.FAILED, reason, reason, now);
    }

    /**
     * Fails the replay because of a desired state that cannot be read.
     *
     * @param sequence of the record
     */
    public Optional<PlaybackRecord> reject(long sequence, String reason, long now) {
        at.sequence = Math.max(at.sequence, sequence);
        return fail(reason, now);
    }

    private Optional<PlaybackRecord> finish(Phase phase, String reason, String endReason, long now) {
        Optional<PlaybackRecord> end = end(endReason, now);
        at.enter(phase, reason);
        ahead.setPrimes(null);
        waiting = null;
        return end;
    }

    /** @param reason why the topic cannot be written to; null if that is unknown */
    public void awaitTopic(String reason) {
        waiting = reason;
    }

    /** Writes an end even for an epoch that could not begin, because consumers of the topic wait for one. */
    private Optional<PlaybackRecord> finishWithEnd(Phase phase, String reason, long now) {
        if (!hasBegun()) {
            at.unopened(desired);
            at.enter(phase, reason);
            return Optional.of(played(PlaybackRecord.Kind.END, null, reason, at.position, now));
        }
        return finish(phase, reason, reason, now);
    }

    /** Returns the end of an epoch that has begun. */
    private Optional<PlaybackRecord> end(String reason, long now) {
        return hasBegun()
                ? Optional.of(played(PlaybackRecord.Kind.END, null, reason, at.position, now))
                : Optional.empty();
    }

    /** Returns whether an epoch has begun and still needs an end. */
    public boolean hasBegun() {
        return at.phase == Phase.PLAYING || at.phase == Phase.PRIMING && (ahead.primes() != null || at.number > 0);
    }

    private void begin(Long start, long now) {
        if (Math.max(at.epoch, usedEpoch) >= Epochs.LAST) {
            at.enter(Phase.FAILED, NO_EPOCH_LEFT);
            return;
        }
        at.beginEpoch(start, usedEpoch);
        at.stamp = Math.max(at.stamp, usedStamp);
        schedule.beginEpoch();
        passBegan = now;
        startOver(now);
    }

    /** Returns the next request, each one once. */
    public Optional<ReadRequest> fetch() {
        return ahead.fetch(at, desired);
    }

    /**
     * Accepts the result of a request.
     *
     * @return the end of the epoch, if this ends one
     */
    public Optional<PlaybackRecord> accept(ReadResult readResult, long now) {
        boolean awaited = !isOver() || isSteppingBackFromEnd() && !(readResult instanceof ReadResult.NextPage);
        if (readResult.epoch() != at.epoch || !awaited) {
            return Optional.empty();
        }
        if (readResult instanceof ReadResult.Unavailable unavailable) {
            waiting = unavailable.reason();
            return Optional.empty();
        }
        ahead.completeFetch();
        waiting = null;
        if (readResult instanceof ReadResult.Failed failed) {
            return finishWithEnd(Phase.FAILED, failed.reason(), now);
        } else if (readResult instanceof ReadResult.Opened opened) {
            if (opened.span().isEmpty()) {
                return finishWithEnd(Phase.ENDED, "mission '" + desired.mission() + "' has no event", now);
            }
            at.opened(opened.span().get(), desired);
            startOver(now);
        } else if (readResult instanceof ReadResult.Primed primed) {
            ahead.setPrimes(primed.primes());
            schedule.anchor(now, at.point);
            ahead.add(primed.first());
        } else if (readResult instanceof ReadResult.NextPage nextPage) {
            boolean stalled = ahead.peek() == null;
            ahead.add(nextPage.page());
            ReadyEvent next = next();
            if (stalled && next != null) {
                schedule.resumeAfterStall(next, now);
            }
        } else if (readResult instanceof ReadResult.SteppedBack steppedBack) {
            return goBack(steppedBack, now);
        }
        return Optional.empty();
    }

    /** Begins the epoch of a step back unless a newer command replaced it. */
    private Optional<PlaybackRecord> goBack(ReadResult.SteppedBack steppedBack, long now) {
        if (!steps().awaits(steppedBack)) {
            return Optional.empty();
        }
        boolean isWithinRecording = steps().isWithin(steppedBack);
        steps().complete(steppedBack);
        Optional<PlaybackRecord> end = end("step", now);
        begin(isWithinRecording ? Long.valueOf(steppedBack.found().time()) : null, now);
        if (isWithinRecording && !isOver()) {
            at.goal = steppedBack.found();
        }
        return end;
    }

    /** Returns the next event; null if it is not read yet. */
    private ReadyEvent next() {
        ReadyEvent next = ahead.peek();
        schedule.shortenGap(next, at.position);
        return next;
    }

    /** Returns the next record if it is due. */
    public Optional<PlaybackRecord> poll(long now) {
        if (at.phase == Phase.BETWEEN && now >= passBegan + MIN_PASS) {
            begin(null, now);
        } else if (at.phase == Phase.PRIMING && ahead.primes() != null && now >= schedule.anchor()) {
            List<ReadyEvent> primes = ahead.primes();
            if (at.primes < primes.size()) {
                return Optional.of(played(PlaybackRecord.Kind.PRIME, primes.get((int) at.primes), null, at.point, now));
            }
            at.enter(Phase.PLAYING, null);
            ahead.setPrimes(null);
        }
        return at.phase == Phase.PLAYING ? play(now) : Optional.empty();
    }

    private Optional<PlaybackRecord> play(long now) {
        boolean atEnd = isAtEnd();
        if (atEnd && now >= schedule.endDue()) {
            return Optional.of(endOfPass(now));
        }
        ReadyEvent next = atEnd ? null : next();
        steps().dropImpossible(next, atEnd);
        if (next == null || !steps().plays(next) && now < schedule.due(next)) {
            return Optional.empty();
        }
        if (schedule.isPaused()) {
            steps().played(next);
            schedule.step(next, now);
        } else {
            schedule.play(next, now);
        }
        at.skipped += ahead.remove();
        return Optional.of(played(PlaybackRecord.Kind.EVENT, next, null, next.time(), now));
    }

    private PlaybackRecord endOfPass(long now) {
        at.skipped += ahead.skippedOfRest();
        boolean again = desired.loops() && (schedule.isOfGroup() || hasSomethingToRepeat());
        PlaybackRecord end = played(PlaybackRecord.Kind.END, null, again ? "loop" : "ended", at.position, now);
        String reason = desired.loops() && !again ? "the recording has no event to repeat" : null;
        at.enter(again ? Phase.BETWEEN : Phase.ENDED, reason);
        if (!again) {
            startOver(now); // drops the buffer: a command behind the end reads again
        }
        return end;
    }

    /** Returns whether a whole pass has an event. */
    private boolean hasSomethingToRepeat() {
        return at.events > 0 || at.point > desired.from(at.first);
    }

    private boolean isAtEnd() {
        return ahead.isOver(desired.to());
    }

    private PlaybackRecord played(PlaybackRecord.Kind kind, ReadyEvent event, String reason, long time, long now) {
        boolean rebased = desired.plan().stamps() == ReplayPlan.Stamps.NOW;
        long offset = rebased // never negative
                ? Math.max(at.stamp, Math.max(time, schedule.wall(now))) - time
                : at.offset;
        PlaybackRecord playbackRecord = new PlaybackRecord(kind, event, reason, at.epoch, at.number, time, offset);
        at.played(playbackRecord);
        return playbackRecord;
    }

    /**
     * Returns when {@link #poll} should be called again, ms of the clock; {@link Long#MAX_VALUE} while it waits for a
     * result or a command.
     */
    public long due() {
        return switch (at.phase) {
            case BETWEEN -> passBegan + MIN_PASS;
            case PRIMING -> ahead.primes() == null ? Timeline.NEVER : schedule.anchor();
            case PLAYING -> {
                if (isAtEnd()) {
                    yield schedule.endDue();
                }
                ReadyEvent next = next();
                yield next == null ? Timeline.NEVER : steps().plays(next) ? Long.MIN_VALUE : schedule.due(next);
            }
            default -> Timeline.NEVER;
        };
    }

    /** Returns the reached event time, epoch ms. */
    private long position(long now) {
        if (at.phase != Phase.PLAYING) {
            return at.position;
        }
        ReadyEvent next = next();
        long max = next == null ? at.position : next.time(); // the time of an event is unknown until it is read
        return schedule.position(now, at.position, max);
    }

    /** Returns the state from which a restart continues. */
    public PlaybackState snapshot(long now) {
        ReadyEvent next = at.phase == Phase.PLAYING ? next() : null;
        PlaybackState state = at.copy();
        state.position = position(now);
        if (next != null && at.cursor.compareTo(Cursor.before(next.time())) < 0) { // skips the filtered events between
            state.cursor = Cursor.before(next.time());
        }
        return state;
    }

    public DesiredReplay desired() {
        return desired;
    }

    /** Returns the sequence of the desired state that was applied last. */
    public long sequence() {
        return at.sequence;
    }

    public long epoch() {
        return at.epoch;
    }

    public boolean isOver() {
        return at.phase.isOver();
    }

    /** Returns whether the replay is over and has no open request. */
    public boolean isIdle() {
        return isOver() && !isSteppingBackFromEnd();
    }

    private boolean isSteppingBackFromEnd() {
        return at.phase == Phase.ENDED && ahead.isFetching();
    }

    /** Returns the delay of the newest event behind its schedule, ms. */
    public long lateness() {
        return schedule.lateness();
    }

    public ReplayStatus.State state() {
        return at.phase.toState(schedule.isPaused());
    }

    /**
     * Returns the status, never as settled.
     *
     * @param worst maximum lateness since the last status, ms
     * @param rate events per second since the last status
     */
    public ReplayStatus status(long now, long worst, double rate) {
        return new ReplayStatus(
                at.sequence,
                state(),
                at.reason,
                false,
                at.progress(position(now), worst, schedule.slip(), rate, awaited(now)));
    }

    /** Returns whether it reads the data that an epoch needs to begin. */
    public boolean isSeeking() {
        return ahead.isFetching() && !isOver() && !hasBegun() && at.phase != Phase.BETWEEN;
    }

    /** Returns what it waits for; null if it does not wait. */
    public String awaited(long now) {
        if (waiting == null && isSeeking() && now - passBegan >= Schedule.STALL) {
            return at.phase == Phase.OPENING
                    ? "seeking: opening the recording"
                    : "seeking: reading the states before %s".formatted(Instant.ofEpochMilli(at.point));
        }
        return waiting == null && !isOver() ? schedule.beginsAt(now) : waiting;
    }
}
