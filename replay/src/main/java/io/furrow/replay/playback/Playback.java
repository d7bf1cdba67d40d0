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
 * Plays one recording as it is requested. It is given the time, in ms of a clock that never steps back, and asks for what it has to know
 * by {@link #fetch}; every record that it returns is to be written at once. Each start, seek, step back and pass of a loop is an
 * epoch: states known before its point, then events, then an end.
 *
 * <p>A replay of a group follows the group's clock: it neither waits for a recording that is slow nor ends before the group does.
 */
public final class Playback {
    /** A pass of a loop takes at least as long, ms: epochs are numbered, and not without end. */
    static final long MIN_PASS = 1_000;

    private static final String NO_EPOCH_LEFT = "all " + (Epochs.LAST + 1) + " epochs are used; start another replay";

    private final Schedule schedule;
    private DesiredReplay desired;
    private final PlaybackState at;
    private ReadAhead ahead;

    /** Greatest epoch that its topic had records of when it went on after a restart. */
    private long used;
    /** Greatest timestamp that its topic had then. */
    private long usedStamp;
    /** Whether no checkpoint knew it. */
    private final boolean withoutState;

    private String waiting;
    private long passBegan;

    /**
     * @param desired what was applied last; of a fresh state what is requested first
     * @param wall epoch ms at a time of the clock
     */
    public Playback(DesiredReplay desired, PlaybackState state, long now, LongUnaryOperator wall) {
        this.desired = desired;
        this.schedule = new Schedule(desired, wall);
        this.at = state.copy();
        boolean fresh = at.sequence < 0;
        this.withoutState = fresh;
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
     * After a restart the topic may have records that the state does not know: the numbers of their epochs are not used again, and the
     * timestamps of other epochs do not step back behind theirs.
     *
     * @param epoch the greatest one that the topic has
     * @param stamp the greatest timestamp that it has, epoch ms
     */
    public void goOnAfter(long epoch, long stamp) {
        used = epoch;
        usedStamp = stamp;
        waiting = null;
        if (withoutState && at.phase == Phase.OPENING && at.epoch <= epoch) {
            begin(at.start, passBegan);
        } else if (withoutState && at.phase == Phase.OPENING) {
            at.stamp = Math.max(at.stamp, stamp);
        }
    }

    private PendingSteps steps() {
        return new PendingSteps(at, desired);
    }

    private boolean isStopped() {
        return desired.desired() == ReplayStatus.State.STOPPED;
    }

    /** Takes what is requested now, unless it is older than what was applied; a record that this ends the epoch with is returned. */
    public Optional<PlaybackRecord> apply(DesiredReplay next, long now) {
        if (next.sequence() <= at.sequence) {
            return Optional.empty();
        }
        boolean seeks = next.seek() != null && next.seek().sequence() > at.sequence;
        boolean plainAgain = at.phase == Phase.BETWEEN && desired.range() != null && next.range() == null;
        long position = position(now);
        long rangeEnd = desired.to();
        schedule.follow(next, at.phase == Phase.PLAYING, now);
        desired = next;
        at.sequence = next.sequence();
        steps().dropObsolete();
        at.goal = schedule.isHeld() ? at.goal : null;
        schedule.anchor(now, position);
        if (isStopped()) {
            return over(Phase.STOPPED, null, "stopped", now);
        }
        if (!seeks && plainAgain) { // plays on behind the range
            begin(schedule.isOfGroup() ? desired.clock().position(schedule.wall(now), desired.speed()) : rangeEnd, now);
        }
        if (!seeks) {
            return Optional.empty();
        }
        Optional<PlaybackRecord> end = end("seek", now);
        begin(next.seek().to(), now);
        return end;
    }

    /** Ends it for good. */
    public Optional<PlaybackRecord> fail(String reason, long now) {
        return over(Phase.FAILED, reason, reason, now);
    }

    /** Ends it because of a record that cannot be read. @param sequence of the record */
    public Optional<PlaybackRecord> refuse(long sequence, String reason, long now) {
        at.sequence = Math.max(at.sequence, sequence);
        return fail(reason, now);
    }

    private Optional<PlaybackRecord> over(Phase how, String reason, String said, long now) {
        Optional<PlaybackRecord> end = end(said, now);
        at.enter(how, reason);
        ahead.setPrimes(null);
        waiting = null;
        return end;
    }

    /** @param reason why its topic cannot be written to, for which it waits; null if it is not known */
    public void awaitTopic(String reason) {
        waiting = reason;
    }

    /** Also an epoch that could not begin: who was given the name of its topic waits for an end. */
    private Optional<PlaybackRecord> closed(Phase how, String reason, long now) {
        if (!hasBegun()) {
            at.unopened(desired);
            at.enter(how, reason);
            return Optional.of(played(PlaybackRecord.Kind.END, null, reason, at.position, now));
        }
        return over(how, reason, reason, now);
    }

    /** Of an epoch that has begun. */
    private Optional<PlaybackRecord> end(String reason, long now) {
        return hasBegun()
                ? Optional.of(played(PlaybackRecord.Kind.END, null, reason, at.position, now))
                : Optional.empty();
    }

    /** Whether an epoch is under way, which ends with a record. */
    public boolean hasBegun() {
        return at.phase == Phase.PLAYING || at.phase == Phase.PRIMING && (ahead.primes() != null || at.number > 0);
    }

    private void begin(Long start, long now) {
        if (Math.max(at.epoch, used) >= Epochs.LAST) {
            at.enter(Phase.FAILED, NO_EPOCH_LEFT);
            return;
        }
        at.beginEpoch(start, used);
        at.stamp = Math.max(at.stamp, usedStamp);
        schedule.beginEpoch();
        passBegan = now;
        startOver(now);
    }

    /** What is to be read next; asked for once. */
    public Optional<ReadRequest> fetch() {
        return ahead.fetch(at, desired);
    }

    /** Takes what was read; a record that this ends the epoch with is returned. */
    public Optional<PlaybackRecord> take(ReadResult readResult, long now) {
        boolean awaited = !isOver() || goesBackFromEnd() && !(readResult instanceof ReadResult.NextPage);
        if (readResult.epoch() != at.epoch || !awaited) {
            return Optional.empty();
        }
        if (readResult instanceof ReadResult.Unavailable away) {
            waiting = away.reason();
            return Optional.empty();
        }
        ahead.answered();
        waiting = null;
        if (readResult instanceof ReadResult.Failed failed) {
            return closed(Phase.FAILED, failed.reason(), now);
        } else if (readResult instanceof ReadResult.Opened opened) {
            if (opened.span().isEmpty()) {
                return closed(Phase.ENDED, "mission '" + desired.mission() + "' has no event", now);
            }
            at.opened(opened.span().get(), desired);
            startOver(now);
        } else if (readResult instanceof ReadResult.Primed primed) {
            ahead.setPrimes(primed.primes());
            schedule.anchor(now, at.point);
            ahead.add(primed.first());
        } else if (readResult instanceof ReadResult.NextPage nextPage) {
            boolean stood = ahead.peek() == null;
            ahead.add(nextPage.page());
            ReadyEvent next = next();
            if (stood && next != null) {
                schedule.resumeAfterStall(next, now);
            }
        } else if (readResult instanceof ReadResult.SteppedBack steppedBack) {
            return goBack(steppedBack, now);
        }
        return Optional.empty();
    }

    /** Unless something else has been asked for meanwhile. */
    private Optional<PlaybackRecord> goBack(ReadResult.SteppedBack steppedBack, long now) {
        if (!steps().awaits(steppedBack)) {
            return Optional.empty();
        }
        boolean within = steps().isWithin(steppedBack);
        steps().done(steppedBack);
        Optional<PlaybackRecord> end = end("step", now);
        begin(within ? Long.valueOf(steppedBack.found().time()) : null, now);
        if (within && !isOver()) {
            at.goal = steppedBack.found();
        }
        return end;
    }

    /** The next event; null if it is not known. */
    private ReadyEvent next() {
        ReadyEvent next = ahead.peek();
        schedule.approach(next, at.position);
        return next;
    }

    /** The next record, if it is due. */
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
        if (schedule.isHeld()) {
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
        String reason = desired.loops() && !again ? "there is no event to play over and over" : null;
        at.enter(again ? Phase.BETWEEN : Phase.ENDED, reason);
        if (!again) {
            startOver(now); // holds nothing that was read: what is asked for behind the end reads anew
        }
        return end;
    }

    /** Whether this pass, if it was a whole one, had an event. */
    private boolean hasSomethingToRepeat() {
        return at.events > 0 || at.point > desired.from(at.first);
    }

    private boolean isAtEnd() {
        return ahead.isOver(desired.to());
    }

    private PlaybackRecord played(PlaybackRecord.Kind kind, ReadyEvent event, String reason, long time, long now) {
        boolean rebased = desired.plan().stamps() == ReplayPlan.Stamps.NOW;
        long offset = rebased // none is negative
                ? Math.max(at.stamp, Math.max(time, schedule.wall(now))) - time
                : at.offset;
        PlaybackRecord playbackRecord = new PlaybackRecord(kind, event, reason, at.epoch, at.number, time, offset);
        at.played(playbackRecord);
        return playbackRecord;
    }

    /** When {@link #poll} should be called again, ms of the clock; {@link Long#MAX_VALUE} where something else must happen first. */
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

    /** Event time that is reached, epoch ms. */
    private long position(long now) {
        if (at.phase != Phase.PLAYING) {
            return at.position;
        }
        ReadyEvent next = next();
        long most = next == null ? at.position : next.time(); // of what is not read yet nobody knows when it was
        return schedule.position(now, at.position, most);
    }

    /** With which it continues after a restart. */
    public PlaybackState snapshot(long now) {
        ReadyEvent next = at.phase == Phase.PLAYING ? next() : null;
        PlaybackState state = at.copy();
        state.position = position(now);
        if (next != null
                && at.cursor.compareTo(Cursor.before(next.time())) < 0) { // nothing that is played lies between
            state.cursor = Cursor.before(next.time());
        }
        return state;
    }

    public DesiredReplay desired() {
        return desired;
    }

    /** Of the desired replay that was applied last. */
    public long sequence() {
        return at.sequence;
    }

    public long epoch() {
        return at.epoch;
    }

    public boolean isOver() {
        return at.phase.isOver();
    }

    /** Whether it is over and waits for nothing to be read. */
    public boolean rests() {
        return isOver() && !goesBackFromEnd();
    }

    private boolean goesBackFromEnd() {
        return at.phase == Phase.ENDED && ahead.isFetching();
    }

    /** By how much the newest event was behind its schedule, ms. */
    public long lateness() {
        return schedule.lateness();
    }

    public ReplayStatus.State state() {
        return at.phase.told(schedule.isHeld());
    }

    /**
     * Not settled.
     *
     * @param worst lateness since the last, ms
     * @param rate events per second since the last
     */
    public ReplayStatus status(long now, long worst, double rate) {
        return new ReplayStatus(
                at.sequence,
                state(),
                at.reason,
                false,
                at.progress(position(now), worst, schedule.slip(), rate, awaited(now)));
    }

    /** Whether it reads what it has to know before an epoch can begin. */
    public boolean isSeeking() {
        return ahead.isFetching() && !isOver() && !hasBegun() && at.phase != Phase.BETWEEN;
    }

    /** What it waits for; null if it waits for nothing. */
    public String awaited(long now) {
        if (waiting == null && isSeeking() && now - passBegan >= Schedule.STALL) {
            return at.phase == Phase.OPENING
                    ? "seeking: the recording is being opened"
                    : "seeking: what was known before %s is being read".formatted(Instant.ofEpochMilli(at.point));
        }
        return waiting == null && !isOver() ? schedule.beginsAt(now) : waiting;
    }
}
