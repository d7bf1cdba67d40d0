package io.furrow.replay.playback;

import java.util.Comparator;
import java.util.List;
import java.util.Optional;
import java.util.Set;

import io.furrow.flink.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.StoredEvent;
import io.furrow.model.control.ReplayStatus;
import io.furrow.model.control.WantedReplay;
import io.furrow.replay.playback.PlaybackState.Phase;

/**
 * Plays one recording as it is wanted. It is told the time, in ms of a clock that never steps back, and asks for what it has to know
 * by {@link #fetch}; every record that it returns is to be written at once. Each start, seek and pass of a loop is an epoch:
 * states known before its point, then events, then an end.
 */
public final class Playback {
    /** A pass of a loop takes at least as long, ms: epochs are numbered, and not without end. */
    static final long SHORTEST_PASS = 1_000;
    /** What stood still for longer goes on where it stood, instead of catching up, ms. */
    static final long STALL = 1_000;

    private static final Comparator<StoredEvent> BY_ENTITY =
            Comparator.comparing(StoredEvent::entityId).thenComparing(StoredEvent::id);

    private WantedReplay wanted;
    private PlaybackState at;
    private Timeline timeline;
    private ReadAhead ahead;
    private List<StoredEvent> primes;
    private boolean fetching;
    private String waiting;
    private long passBegan;
    private long lateness;

    /** @param wanted what was applied last; of a fresh state what is wanted first */
    public Playback(WantedReplay wanted, PlaybackState state, long now) {
        this.wanted = wanted;
        boolean fresh = state.sequence() < 0;
        this.passBegan = fresh ? now : now - SHORTEST_PASS;
        Long start = fresh && wanted.seek() != null ? Long.valueOf(wanted.seek().to()) : state.start();
        this.at = Moves.of(state, wanted.sequence(), start);
        if (fresh) {
            at = Moves.steps(at, obsoleteSteps());
        }
        if (fresh && isStopped()) {
            at = Moves.over(at, Phase.STOPPED, null);
        }
        startOver(now);
    }

    private void startOver(long now) {
        timeline = new Timeline(now, at.position(), wanted.speed(), isHeld());
        ahead = new ReadAhead(Set.copyOf(wanted.devices()), at.cursor());
        primes = null;
        fetching = false;
        waiting = null;
    }

    private boolean isHeld() {
        return wanted.wanted() == ReplayStatus.State.PAUSED;
    }

    private boolean isStopped() {
        return wanted.wanted() == ReplayStatus.State.STOPPED;
    }

    /** Takes what is wanted now, unless it is older than what was applied; a record that this ends the epoch with is returned. */
    public Optional<Played> apply(WantedReplay next, long now) {
        if (next.sequence() <= at.sequence()) {
            return Optional.empty();
        }
        boolean seeks = next.seek() != null && next.seek().sequence() > at.sequence();
        long position = position(now);
        wanted = next;
        at = Moves.of(at, next.sequence(), at.start());
        at = Moves.steps(at, obsoleteSteps());
        timeline = new Timeline(now, position, next.speed(), isHeld());
        if (isStopped()) {
            return over(Phase.STOPPED, null, "stopped");
        }
        if (!seeks) {
            return Optional.empty();
        }
        Optional<Played> end = end("seek");
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
    public Optional<Played> fail(String reason) {
        return over(Phase.FAILED, reason, reason);
    }

    private Optional<Played> over(Phase how, String reason, String said) {
        Optional<Played> end = end(said);
        at = Moves.over(at, how, reason);
        primes = null;
        waiting = null;
        return end;
    }

    /** Of an epoch that has begun. */
    private Optional<Played> end(String reason) {
        boolean begun =
                at.phase() == Phase.PLAYING || at.phase() == Phase.PRIMING && (primes != null || at.number() > 0);
        return begun ? Optional.of(played(Played.Kind.END, null, reason, at.position())) : Optional.empty();
    }

    private void begin(Long start, long now) {
        if (at.epoch() == Epochs.LAST) {
            at = Moves.over(at, Phase.FAILED, "all " + (Epochs.LAST + 1) + " epochs are used; start another replay");
            return;
        }
        at = Moves.nextEpoch(at, start);
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
            next = new Fetch.Begin(at.epoch(), at.point(), from, at.point() > at.first());
        } else if (at.phase() == Phase.PLAYING && ahead.wantsMore()) {
            next = new Fetch.Next(at.epoch(), ahead.loaded());
        }
        fetching = next != null;
        return Optional.ofNullable(next);
    }

    /** Takes what was read; a record that this ends the epoch with is returned. */
    public Optional<Played> take(Fetched fetched, long now) {
        if (fetched.epoch() != at.epoch() || at.phase().isOver()) {
            return Optional.empty();
        }
        if (fetched instanceof Fetched.Waiting away) {
            waiting = away.reason();
            return Optional.empty();
        }
        fetching = false;
        waiting = null;
        if (fetched instanceof Fetched.Gone gone) {
            return over(Phase.FAILED, gone.reason(), gone.reason());
        } else if (fetched instanceof Fetched.Opened opened) {
            at = opened.span()
                    .map(span -> Moves.opened(at, span, wanted))
                    .orElseGet(() -> Moves.over(at, Phase.ENDED, "mission '" + wanted.mission() + "' has no event"));
            startOver(now);
        } else if (fetched instanceof Fetched.Begun begun) {
            primes = begun.primes().stream()
                    .filter(ahead::isWanted)
                    .sorted(BY_ENTITY)
                    .toList();
            timeline = timeline.anchored(now, at.point());
            at = Moves.skipped(at, ahead.add(begun.first()));
        } else if (fetched instanceof Fetched.More more) {
            boolean stood = ahead.peek() == null;
            at = Moves.skipped(at, ahead.add(more.page()));
            resumeAfterStall(stood, now);
        }
        return Optional.empty();
    }

    private void resumeAfterStall(boolean stood, long now) {
        StoredEvent next = ahead.peek();
        if (stood && next != null && !timeline.held() && now - timeline.due(next.time()) > STALL) {
            timeline = timeline.anchored(now, next.time());
        }
    }

    /** The next record, if it is due. */
    public Optional<Played> poll(long now) {
        if (at.phase() == Phase.BETWEEN && now >= passBegan + SHORTEST_PASS) {
            begin(null, now);
        } else if (at.phase() == Phase.PRIMING && primes != null) {
            if (at.primes() < primes.size()) {
                return Optional.of(played(Played.Kind.PRIME, primes.get((int) at.primes()), null, at.point()));
            }
            at = Moves.playing(at);
        }
        return at.phase() == Phase.PLAYING ? play(now) : Optional.empty();
    }

    private Optional<Played> play(long now) {
        StoredEvent next = ahead.peek();
        if (isAtEnd()) {
            Played end = played(Played.Kind.END, null, wanted.loop() ? "loop" : "ended", at.position());
            at = Moves.over(at, wanted.loop() ? Phase.BETWEEN : Phase.ENDED, null);
            return Optional.of(end);
        }
        if (next == null || !mayStep() && now < timeline.due(next.time())) {
            return Optional.empty();
        }
        if (isHeld()) {
            at = Moves.steps(at, at.steps() + 1);
            timeline = timeline.anchored(now, next.time());
            lateness = 0;
        } else {
            lateness = Double.isInfinite(wanted.speed()) ? 0 : now - timeline.due(next.time());
        }
        ahead.remove();
        return Optional.of(played(Played.Kind.EVENT, next, null, next.time()));
    }

    private boolean mayStep() {
        return isHeld() && wanted.step() != null && wanted.step().total() > at.steps();
    }

    private boolean isAtEnd() {
        StoredEvent next = ahead.peek();
        return ahead.isOver() || next != null && wanted.to() != null && next.time() >= wanted.to();
    }

    private Played played(Played.Kind kind, StoredEvent event, String reason, long time) {
        Played played = new Played(kind, event, reason, at.epoch(), at.number(), time, at.offset());
        at = Moves.played(at, played);
        return played;
    }

    /** When {@link #poll} should be called again, ms of the clock; {@link Long#MAX_VALUE} where something else must happen first. */
    public long due() {
        return switch (at.phase()) {
            case BETWEEN -> passBegan + SHORTEST_PASS;
            case PRIMING -> primes == null ? Timeline.NEVER : 0;
            case PLAYING -> {
                if (isAtEnd()) {
                    yield 0;
                }
                StoredEvent next = ahead.peek();
                yield next == null ? Timeline.NEVER : mayStep() ? 0 : timeline.due(next.time());
            }
            default -> Timeline.NEVER;
        };
    }

    /** Event time that is reached, epoch ms. */
    private long position(long now) {
        if (at.phase() != Phase.PLAYING) {
            return at.position();
        }
        StoredEvent next = ahead.peek();
        long most = next == null ? at.position() : next.time(); // of what is not read yet nobody knows when it was
        return timeline.at(now, at.position(), Math.max(at.position(), most));
    }

    /** With which it goes on after a restart. */
    public PlaybackState snapshot(long now) {
        return Moves.at(at, position(now));
    }

    public WantedReplay wanted() {
        return wanted;
    }

    public boolean isOver() {
        return at.phase().isOver();
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
                at.sequence(), state(), at.reason(), false, at.progress(position, worst, rate, waiting));
    }
}
