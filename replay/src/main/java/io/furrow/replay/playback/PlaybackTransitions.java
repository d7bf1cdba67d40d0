package io.furrow.replay.playback;

import io.furrow.flink.record.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingExtent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.replay.playback.PlaybackState.Phase;

/** What a step makes of a {@link PlaybackState}: each is the state before it with a few members changed. */
final class PlaybackTransitions {
    private long sequence;
    private Phase phase;
    private String reason;
    private long epoch;
    private long number;
    private long offset;
    private long stamp;
    private Long start;
    private long point;
    private Cursor cursor;
    private long position;
    private long first;
    private long last;
    private long steps;
    private long events;
    private long primes;
    private long skipped;
    private Cursor goal;

    private PlaybackTransitions(PlaybackState s) {
        sequence = s.sequence();
        phase = s.phase();
        reason = s.reason();
        epoch = s.epoch();
        number = s.number();
        offset = s.offset();
        stamp = s.stamp();
        start = s.start();
        point = s.point();
        cursor = s.cursor();
        position = s.position();
        first = s.first();
        last = s.last();
        steps = s.steps();
        events = s.events();
        primes = s.primes();
        skipped = s.skipped();
        goal = s.goal();
    }

    private PlaybackState done() {
        return new PlaybackState(
                sequence, phase, reason, epoch, number, offset, stamp, start, point, cursor, position, first, last,
                steps, events, primes, skipped, goal);
    }

    static PlaybackState of(PlaybackState s, long sequence, Long start) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.sequence = sequence;
        next.start = start;
        return next.done();
    }

    static PlaybackState over(PlaybackState s, Phase phase, String reason) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.phase = phase;
        next.reason = reason;
        next.start = null;
        return next.done();
    }

    static PlaybackState playing(PlaybackState s) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.phase = Phase.PLAYING;
        next.reason = null;
        next.start = null;
        return next.done();
    }

    static PlaybackState steps(PlaybackState s, long steps) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.steps = steps;
        return next.done();
    }

    static PlaybackState skipped(PlaybackState s, long more) {
        if (more == 0) {
            return s;
        }
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.skipped += more;
        return next.done();
    }

    static PlaybackState at(PlaybackState s, long position) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.position = position;
        return next.done();
    }

    /** Nothing that is played lies between the cursor and this event time, epoch ms. */
    static PlaybackState before(PlaybackState s, long time) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        Cursor before = Cursor.before(time);
        next.cursor = s.cursor().compareTo(before) < 0 ? before : s.cursor();
        return next.done();
    }

    /** @param goal null for none */
    static PlaybackState towards(PlaybackState s, Cursor goal) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.goal = goal;
        return next.done();
    }

    /**
     * @param start epoch ms; null for the replay's beginning
     * @param used greatest epoch that is known to be used
     */
    static PlaybackState nextEpoch(PlaybackState s, Long start, long used) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.phase = Phase.OPENING;
        next.reason = null;
        next.epoch = Math.max(s.epoch(), used) + 1;
        next.number = 0;
        next.start = start;
        next.cursor = Cursor.START;
        next.events = 0;
        next.primes = 0;
        next.skipped = 0;
        next.goal = null;
        return next.done();
    }

    /** @param stamp below which no timestamp may be */
    static PlaybackState stamped(PlaybackState s, long stamp) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.stamp = Math.max(s.stamp(), stamp);
        return next.done();
    }

    /** The offset grows where timestamps would step back. */
    static PlaybackState opened(PlaybackState s, RecordingExtent recordingExtent, DesiredReplay desired) {
        long point = point(s.start(), recordingExtent, desired);
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.phase = Phase.PRIMING;
        next.reason = null;
        next.offset = Math.max(s.offset(), s.stamp() - point);
        next.start = null;
        next.point = point;
        next.cursor = point <= recordingExtent.first() ? Cursor.START : Cursor.before(point);
        next.position = point;
        next.first = recordingExtent.first();
        next.last = recordingExtent.last();
        return next.done();
    }

    /** The epoch would have begun there, as far as that is known. */
    static PlaybackState unopened(PlaybackState s, DesiredReplay desired) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        long begin = s.start() == null ? desired.from(s.first()) : s.start();
        next.position = within(0, begin, Epochs.SPAN - 1);
        next.offset = Math.max(s.offset(), s.stamp() - next.position);
        return next.done();
    }

    /** Where the epoch begins: as asked for, but within the recording and what is requested of it. */
    private static long point(Long start, RecordingExtent recordingExtent, DesiredReplay desired) {
        long from = desired.from(recordingExtent.first());
        long to = Math.min(recordingExtent.last() + 1, desired.to());
        long least = within(0, from, Epochs.SPAN - 1);
        return start == null ? least : within(least, start, Math.max(least, Math.min(to, Epochs.SPAN - 1)));
    }

    private static long within(long least, long number, long most) {
        return Math.max(least, Math.min(number, most));
    }

    static PlaybackState played(PlaybackState s, PlaybackRecord playbackRecord) {
        PlaybackTransitions next = new PlaybackTransitions(s);
        next.number++;
        next.offset = playbackRecord.offset();
        next.stamp = Math.max(s.stamp(), playbackRecord.stamp());
        next.position = playbackRecord.time();
        if (playbackRecord.kind() == PlaybackRecord.Kind.EVENT) {
            next.cursor = playbackRecord.event().cursor();
            next.events++;
        } else if (playbackRecord.kind() == PlaybackRecord.Kind.PRIME) {
            next.primes++;
        }
        return next.done();
    }
}
