package io.furrow.replay.playback;

import io.furrow.flink.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.Span;
import io.furrow.model.control.WantedReplay;
import io.furrow.replay.playback.PlaybackState.Phase;

/** What a step makes of a {@link PlaybackState}: each is the state before it with a few members changed. */
final class Moves {
    private Moves() {}

    static PlaybackState of(PlaybackState s, long sequence, Long start) {
        return copy(s, sequence, s.phase(), s.reason(), start, s.position(), s.steps(), s.skipped());
    }

    static PlaybackState over(PlaybackState s, Phase phase, String reason) {
        return copy(s, s.sequence(), phase, reason, null, s.position(), s.steps(), s.skipped());
    }

    static PlaybackState playing(PlaybackState s) {
        return copy(s, s.sequence(), Phase.PLAYING, null, null, s.position(), s.steps(), s.skipped());
    }

    static PlaybackState steps(PlaybackState s, long steps) {
        return copy(s, s.sequence(), s.phase(), s.reason(), s.start(), s.position(), steps, s.skipped());
    }

    static PlaybackState skipped(PlaybackState s, long more) {
        return copy(s, s.sequence(), s.phase(), s.reason(), s.start(), s.position(), s.steps(), s.skipped() + more);
    }

    static PlaybackState at(PlaybackState s, long position) {
        return copy(s, s.sequence(), s.phase(), s.reason(), s.start(), position, s.steps(), s.skipped());
    }

    private static PlaybackState copy(
            PlaybackState s,
            long sequence,
            Phase phase,
            String reason,
            Long start,
            long position,
            long steps,
            long skipped) {
        return new PlaybackState(
                sequence,
                phase,
                reason,
                s.epoch(),
                s.number(),
                s.offset(),
                s.stamp(),
                start,
                s.point(),
                s.cursor(),
                position,
                s.first(),
                s.last(),
                steps,
                s.events(),
                s.primes(),
                skipped);
    }

    /** @param start epoch ms; null for the replay's beginning */
    static PlaybackState nextEpoch(PlaybackState s, Long start) {
        return new PlaybackState(
                s.sequence(),
                Phase.OPENING,
                null,
                s.epoch() + 1,
                0,
                s.offset(),
                s.stamp(),
                start,
                s.point(),
                Cursor.START,
                s.position(),
                s.first(),
                s.last(),
                s.steps(),
                0,
                0,
                0);
    }

    /** The offset grows where timestamps would step back. */
    static PlaybackState opened(PlaybackState s, Span span, WantedReplay wanted) {
        long point = point(s.start(), span, wanted);
        return new PlaybackState(
                s.sequence(),
                Phase.PRIMING,
                null,
                s.epoch(),
                s.number(),
                Math.max(s.offset(), s.stamp() - point),
                s.stamp(),
                null,
                point,
                point <= span.first() ? Cursor.START : Cursor.before(point),
                point,
                span.first(),
                span.last(),
                s.steps(),
                s.events(),
                s.primes(),
                s.skipped());
    }

    /** Where the epoch begins: as asked for, but within the recording and what is wanted of it. */
    private static long point(Long start, Span span, WantedReplay wanted) {
        long from = wanted.from() == null ? span.first() : Math.max(span.first(), wanted.from());
        long to = wanted.to() == null ? span.last() + 1 : Math.min(span.last() + 1, wanted.to());
        long least = within(0, from, Epochs.SPAN - 1);
        return start == null ? least : within(least, start, Math.max(least, Math.min(to, Epochs.SPAN - 1)));
    }

    private static long within(long least, long number, long most) {
        return Math.max(least, Math.min(number, most));
    }

    static PlaybackState played(PlaybackState s, Played played) {
        boolean event = played.kind() == Played.Kind.EVENT;
        boolean prime = played.kind() == Played.Kind.PRIME;
        return new PlaybackState(
                s.sequence(),
                s.phase(),
                s.reason(),
                s.epoch(),
                s.number() + 1,
                s.offset(),
                Math.max(s.stamp(), played.stamp()),
                s.start(),
                s.point(),
                event ? Cursor.after(played.event()) : s.cursor(),
                played.time(),
                s.first(),
                s.last(),
                s.steps(),
                s.events() + (event ? 1 : 0),
                s.primes() + (prime ? 1 : 0),
                s.skipped());
    }
}
