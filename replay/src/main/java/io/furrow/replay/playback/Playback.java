package io.furrow.replay.playback;

import java.time.Instant;
import java.util.List;
import java.util.Optional;
import java.util.function.LongUnaryOperator;

import io.furrow.flink.time.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.model.control.replay.ReplayPlan;
import io.furrow.model.control.replay.ReplayStatus;
import io.furrow.model.control.replay.WantedReplay;
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
    /** What stood still for longer continues where it stood, instead of catching up, ms. */
    static final long STALL = 1_000;

    /** Events that are stepped back over at once. */
    static final int MAX_BACK = 100_000;

    private static final String NO_EPOCH_LEFT = "all " + (Epochs.LAST + 1) + " epochs are used; start another replay";
    /** A page is what is played in this time, ms. */
    private static final double PAGE = 2_000;

    private final LongUnaryOperator wall;
    private WantedReplay wanted;
    private PlaybackState at;
    private Timeline timeline;
    /** The next event that has been looked at for what lies before it. */
    private ReadyEvent approached;

    private ReadAhead ahead;
    private List<ReadyEvent> primes;
    private boolean fetching;
    /** Whether it is in the pass of a loop that the group's clock comes to next. */
    private boolean aheadOfClock;

    /** Greatest epoch that its topic had records of when it went on after a restart. */
    private long used;
    /** Greatest timestamp that its topic had then. */
    private long usedStamp;
    /** Whether no checkpoint knew it. */
    private final boolean withoutState;

    private String waiting;
    private long passBegan;
    private long lateness;
    /** Of the epoch, since the last restart. */
    private long slip;

    /**
     * @param wanted what was applied last; of a fresh state what is requested first
     * @param wall epoch ms at a time of the clock
     */
    public Playback(WantedReplay wanted, PlaybackState state, long now, LongUnaryOperator wall) {
        this.wanted = wanted;
        this.wall = wall;
        boolean fresh = state.sequence() < 0;
        this.withoutState = fresh;
        this.passBegan = fresh ? now : now - MIN_PASS;
        Long start = fresh && wanted.seek() != null ? Long.valueOf(wanted.seek().to()) : state.start();
        this.at = Moves.of(state, wanted.sequence(), start);
        if (fresh) {
            at = Moves.steps(at, obsoleteSteps());
        }
        if (fresh && isStopped()) {
            at = Moves.over(at, Phase.STOPPED, null);
        } else if (at.epoch() > Epochs.LAST) {
            at = Moves.over(at, Phase.FAILED, NO_EPOCH_LEFT);
        }
        startOver(now);
    }

    private void startOver(long now) {
        anchor(now, at.position());
        ahead = new ReadAhead(at.cursor());
        primes = null;
        fetching = false;
        waiting = null;
    }

    /** From now on the position is played at this moment, or when the replay shall start; in a group when its clock says so. */
    private void anchor(long now, long position) {
        approached = null;
        long today = wall.applyAsLong(now);
        if (isOfGroup()) {
            timeline = GroupTimeline.of(wanted, now, today, aheadOfClock);
        } else {
            Long startAt = wanted.plan().startAt();
            long wait = startAt == null ? 0 : Math.max(0, startAt - today);
            timeline = new Timeline(now + wait, position, wanted.speed(), isHeld());
        }
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
        if (withoutState && at.phase() == Phase.OPENING && at.epoch() <= epoch) {
            begin(at.start(), passBegan);
        } else if (withoutState && at.phase() == Phase.OPENING) {
            at = Moves.stamped(at, stamp);
        }
    }

    private boolean isOfGroup() {
        return wanted.clock() != null;
    }

    private boolean isHeld() {
        return wanted.wanted() == ReplayStatus.State.PAUSED;
    }

    private boolean isStopped() {
        return wanted.wanted() == ReplayStatus.State.STOPPED;
    }

    /** Takes what is requested now, unless it is older than what was applied; a record that this ends the epoch with is returned. */
    public Optional<Played> apply(WantedReplay next, long now) {
        if (next.sequence() <= at.sequence()) {
            return Optional.empty();
        }
        boolean seeks = next.seek() != null && next.seek().sequence() > at.sequence();
        boolean plainAgain = at.phase() == Phase.BETWEEN && wanted.range() != null && next.range() == null;
        long position = position(now);
        long rangeEnd = wanted.to();
        aheadOfClock = isOfGroup() && at.phase() == Phase.PLAYING && GroupTimeline.isAPassAhead(timeline, next, now);
        wanted = next;
        at = Moves.of(at, next.sequence(), at.start());
        at = Moves.steps(at, obsoleteSteps());
        at = isHeld() ? at : Moves.towards(at, null);
        anchor(now, position);
        if (isStopped()) {
            return over(Phase.STOPPED, null, "stopped", now);
        }
        if (!seeks && plainAgain) { // plays on behind the range
            begin(isOfGroup() ? wanted.clock().position(wall.applyAsLong(now), wanted.speed()) : rangeEnd, now);
        }
        if (!seeks) {
            return Optional.empty();
        }
        Optional<Played> end = end("seek", now);
        begin(next.seek().to(), now);
        return end;
    }

    /** Those asked for before a jump, or while it runs, are not made up for. */
    private long obsoleteSteps() {
        WantedReplay.Step step = wanted.step();
        WantedReplay.Seek seek = wanted.seek();
        boolean obsolete = step != null && (!isHeld() || seek != null && seek.sequence() > step.sequence());
        return obsolete ? step.total() : at.steps();
    }

    /** Ends it for good. */
    public Optional<Played> fail(String reason, long now) {
        return over(Phase.FAILED, reason, reason, now);
    }

    /** Ends it because of a record that cannot be read. @param sequence of the record */
    public Optional<Played> refuse(long sequence, String reason, long now) {
        at = Moves.of(at, Math.max(at.sequence(), sequence), at.start());
        return fail(reason, now);
    }

    private Optional<Played> over(Phase how, String reason, String said, long now) {
        Optional<Played> end = end(said, now);
        at = Moves.over(at, how, reason);
        primes = null;
        waiting = null;
        return end;
    }

    /** @param reason why its topic cannot be written to, for which it waits; null if it is not known */
    public void awaitTopic(String reason) {
        waiting = reason;
    }

    /** Also an epoch that could not begin: who was given the name of its topic waits for an end. */
    private Optional<Played> closed(Phase how, String reason, long now) {
        if (!hasBegun()) {
            at = Moves.unopened(at, wanted);
            at = Moves.over(at, how, reason);
            return Optional.of(played(Played.Kind.END, null, reason, at.position(), now));
        }
        return over(how, reason, reason, now);
    }

    /** Of an epoch that has begun. */
    private Optional<Played> end(String reason, long now) {
        return hasBegun() ? Optional.of(played(Played.Kind.END, null, reason, at.position(), now)) : Optional.empty();
    }

    /** Whether an epoch is under way, which ends with a record. */
    public boolean hasBegun() {
        return at.phase() == Phase.PLAYING || at.phase() == Phase.PRIMING && (primes != null || at.number() > 0);
    }

    private void begin(Long start, long now) {
        if (Math.max(at.epoch(), used) >= Epochs.LAST) {
            at = Moves.over(at, Phase.FAILED, NO_EPOCH_LEFT);
            return;
        }
        at = Moves.stamped(Moves.nextEpoch(at, start, used), usedStamp);
        aheadOfClock = false;
        slip = 0;
        passBegan = now;
        startOver(now);
    }

    /** What is to be read next; asked for once. */
    public Optional<Fetch> fetch() {
        if (fetching) {
            return Optional.empty();
        }
        Fetch next = null;
        if (at.phase() == Phase.OPENING) {
            next = new Fetch.Open(at.epoch());
        } else if (at.phase() == Phase.PRIMING && primes == null) {
            Cursor from = at.point() <= at.first() ? Cursor.START : Cursor.before(at.point());
            next = new Fetch.Begin(at.epoch(), at.point(), from, at.point() > at.first(), pageEvents());
        } else if (wantsBack()) {
            next = new Fetch.Back(at.epoch(), at.cursor(), beginning(), stepsBack());
        } else if (at.phase() == Phase.PLAYING && ahead.wantsMore(wanted.to())) {
            next = new Fetch.Next(at.epoch(), ahead.loaded(), pageEvents());
        }
        fetching = next != null;
        return Optional.ofNullable(next);
    }

    private int pageEvents() {
        return ahead.expected(PAGE * wanted.speed());
    }

    /** Takes what was read; a record that this ends the epoch with is returned. */
    public Optional<Played> take(Fetched fetched, long now) {
        boolean awaited = !isOver() || goesBackFromEnd() && !(fetched instanceof Fetched.More);
        if (fetched.epoch() != at.epoch() || !awaited) {
            return Optional.empty();
        }
        if (fetched instanceof Fetched.Waiting away) {
            waiting = away.reason();
            return Optional.empty();
        }
        fetching = false;
        waiting = null;
        if (fetched instanceof Fetched.Gone gone) {
            return closed(Phase.FAILED, gone.reason(), now);
        } else if (fetched instanceof Fetched.Opened opened) {
            if (opened.span().isEmpty()) {
                return closed(Phase.ENDED, "mission '" + wanted.mission() + "' has no event", now);
            }
            at = Moves.opened(at, opened.span().get(), wanted);
            startOver(now);
        } else if (fetched instanceof Fetched.Begun begun) {
            primes = begun.primes();
            anchor(now, at.point());
            add(begun.first());
        } else if (fetched instanceof Fetched.More more) {
            boolean stood = ahead.peek() == null;
            add(more.page());
            resumeAfterStall(stood, now);
        } else if (fetched instanceof Fetched.Back back) {
            return goBack(back, now);
        }
        return Optional.empty();
    }

    private void add(ReadyPage page) {
        ahead.add(page);
        at = Moves.skipped(at, page.skipped());
    }

    private void resumeAfterStall(boolean stood, long now) {
        ReadyEvent next = next();
        if (stood && next != null && !isOfGroup() && !isHeld() && now - timeline.due(next.time()) > STALL) {
            slip += now - timeline.due(next.time());
            anchor(now, next.time());
        }
    }

    /** Unless something else has been asked for meanwhile. */
    private Optional<Played> goBack(Fetched.Back back, long now) {
        if (!wantsBack() || back.count() > stepsBack()) {
            return Optional.empty();
        }
        boolean within = !back.found().equals(beginning());
        at = Moves.steps(at, within ? at.steps() - back.count() : wanted.step().total());
        Optional<Played> end = end("step", now);
        begin(within ? Long.valueOf(back.found().time()) : null, now);
        if (within && !isOver()) {
            at = Moves.towards(at, back.found());
        }
        return end;
    }

    private Cursor beginning() {
        return Cursor.before(wanted.from(at.first()));
    }

    /** The next event; null if it is not known. What lies before it is shortened to the longest gap. */
    private ReadyEvent next() {
        ReadyEvent next = ahead.peek();
        Long longest = wanted.plan().maxGap();
        if (next != null && next != approached && longest != null && !isHeld() && !isOfGroup()) {
            approached = next;
            long gap = next.time() - Math.max(at.position(), timeline.origin());
            if (gap > longest) {
                timeline = timeline.skipping(gap - longest);
            }
        }
        return next;
    }

    /** The next record, if it is due. */
    public Optional<Played> poll(long now) {
        if (at.phase() == Phase.BETWEEN && now >= passBegan + MIN_PASS) {
            begin(null, now);
        } else if (at.phase() == Phase.PRIMING && primes != null && now >= timeline.anchor()) {
            if (at.primes() < primes.size()) {
                return Optional.of(played(Played.Kind.PRIME, primes.get((int) at.primes()), null, at.point(), now));
            }
            at = Moves.playing(at);
        }
        return at.phase() == Phase.PLAYING ? play(now) : Optional.empty();
    }

    private Optional<Played> play(long now) {
        if (isAtEnd() && now >= endDue()) {
            boolean again = wanted.loops() && (isOfGroup() || hasSomethingToRepeat());
            Played end = played(Played.Kind.END, null, again ? "loop" : "ended", at.position(), now);
            String reason = wanted.loops() && !again ? "there is no event to play over and over" : null;
            at = Moves.over(at, again ? Phase.BETWEEN : Phase.ENDED, reason);
            if (!again) {
                startOver(now); // holds nothing that was read: what is asked for behind the end reads anew
            }
            return Optional.of(end);
        }
        ReadyEvent next = isAtEnd() ? null : next();
        dropWhatCannotBeStepped(next);
        if (next == null || !mayStep(next) && now < timeline.due(next.time())) {
            return Optional.empty();
        }
        if (isHeld()) {
            step(next, now);
        } else {
            lateness = Double.isInfinite(wanted.speed()) ? 0 : now - timeline.due(next.time());
        }
        ahead.remove();
        return Optional.of(played(Played.Kind.EVENT, next, null, next.time(), now));
    }

    /** A goal that lies behind what is played next or at all, and steps forward at the end. */
    private void dropWhatCannotBeStepped(ReadyEvent next) {
        boolean passed = next != null && at.goal() != null && next.cursor().compareTo(at.goal()) > 0;
        if (passed || isAtEnd()) {
            at = Moves.towards(at, null);
        }
        if (isAtEnd() && wanted.step() != null && wanted.step().total() > at.steps()) {
            at = Moves.steps(at, wanted.step().total());
        }
    }

    private void step(ReadyEvent next, long now) {
        if (at.goal() == null) {
            at = Moves.steps(at, at.steps() + 1);
        } else if (next.cursor().compareTo(at.goal()) >= 0) {
            at = Moves.towards(at, null);
        }
        anchor(now, next.time());
        lateness = 0;
    }

    /** Whether a replay that is held plays the event. */
    private boolean mayStep(ReadyEvent next) {
        boolean repeats = at.goal() != null && next.cursor().compareTo(at.goal()) <= 0;
        boolean steps = wanted.step() != null && wanted.step().total() > at.steps();
        return isHeld() && !isOfGroup() && (repeats || steps);
    }

    /** Also from its end. */
    private boolean wantsBack() {
        return (at.phase() == Phase.PLAYING || at.phase() == Phase.ENDED)
                && at.goal() == null
                && isHeld()
                && !isOfGroup()
                && wanted.step() != null
                && wanted.step().total() < at.steps();
    }

    /** Whether this pass, if it was a whole one, had an event. */
    private boolean hasSomethingToRepeat() {
        return at.events() > 0 || at.point() > wanted.from(at.first());
    }

    /** As many as are found at once. */
    private long stepsBack() {
        return Math.min(at.steps() - wanted.step().total(), MAX_BACK);
    }

    private boolean isAtEnd() {
        return ahead.isOver(wanted.to());
    }

    /** When an epoch ends that has no more events: at once, or with the group; not while it is held, so that one can go back. */
    private long endDue() {
        if (isHeld()) {
            return Timeline.NEVER;
        }
        return isOfGroup() ? timeline.due(wanted.to()) : Long.MIN_VALUE;
    }

    private Played played(Played.Kind kind, ReadyEvent event, String reason, long time, long now) {
        boolean rebased = wanted.plan().stamps() == ReplayPlan.Stamps.NOW;
        long offset = rebased // none is negative
                ? Math.max(at.stamp(), Math.max(time, wall.applyAsLong(now))) - time
                : at.offset();
        Played played = new Played(kind, event, reason, at.epoch(), at.number(), time, offset);
        at = Moves.played(at, played);
        return played;
    }

    /** When {@link #poll} should be called again, ms of the clock; {@link Long#MAX_VALUE} where something else must happen first. */
    public long due() {
        return switch (at.phase()) {
            case BETWEEN -> passBegan + MIN_PASS;
            case PRIMING -> primes == null ? Timeline.NEVER : timeline.anchor();
            case PLAYING -> {
                if (isAtEnd()) {
                    yield endDue();
                }
                ReadyEvent next = next();
                yield next == null ? Timeline.NEVER : mayStep(next) ? Long.MIN_VALUE : timeline.due(next.time());
            }
            default -> Timeline.NEVER;
        };
    }

    /** Event time that is reached, epoch ms. */
    private long position(long now) {
        if (at.phase() != Phase.PLAYING) {
            return at.position();
        }
        ReadyEvent next = next();
        long most = next == null ? at.position() : next.time(); // of what is not read yet nobody knows when it was
        return timeline.at(now, at.position(), Math.max(at.position(), most));
    }

    /** With which it continues after a restart. */
    public PlaybackState snapshot(long now) {
        return Moves.at(at, position(now));
    }

    public WantedReplay wanted() {
        return wanted;
    }

    /** Of the desired replay that was applied last. */
    public long sequence() {
        return at.sequence();
    }

    public long epoch() {
        return at.epoch();
    }

    public boolean isOver() {
        return at.phase().isOver();
    }

    /** Whether it is over and waits for nothing to be read. */
    public boolean rests() {
        return isOver() && !goesBackFromEnd();
    }

    private boolean goesBackFromEnd() {
        return at.phase() == Phase.ENDED && fetching;
    }

    /** By how much the newest event was behind its schedule, ms. */
    public long lateness() {
        return lateness;
    }

    public ReplayStatus.State state() {
        return at.phase().told(isHeld());
    }

    /**
     * Not settled.
     *
     * @param worst lateness since the last, ms
     * @param rate events per second since the last
     */
    public ReplayStatus status(long now, long worst, double rate) {
        long position = waiting == null ? position(now) : at.position();
        return new ReplayStatus(
                at.sequence(), state(), at.reason(), false, at.progress(position, worst, slip, rate, awaited(now)));
    }

    /** Whether it reads what it has to know before an epoch can begin. */
    public boolean isSeeking() {
        return fetching && !isOver() && !hasBegun() && at.phase() != Phase.BETWEEN;
    }

    /** What it waits for; null if it waits for nothing. */
    public String awaited(long now) {
        if (waiting == null && isSeeking() && now - passBegan >= STALL) {
            return at.phase() == Phase.OPENING
                    ? "seeking: the recording is being opened"
                    : "seeking: what was known before %s is being read".formatted(Instant.ofEpochMilli(at.point()));
        }
        boolean early = !at.phase().isOver() && !isHeld() && now < timeline.anchor();
        return waiting == null && early
                ? "begins at " + Instant.ofEpochMilli(wall.applyAsLong(now) + timeline.anchor() - now)
                : waiting;
    }
}
