package io.furrow.replay.playback;

import java.io.DataInput;
import java.io.DataOutput;
import java.io.IOException;
import java.nio.charset.StandardCharsets;

import io.furrow.flink.record.Epochs;
import io.furrow.mission.Cursor;
import io.furrow.mission.RecordingExtent;
import io.furrow.model.control.DesiredReplay;
import io.furrow.model.control.ReplayStatus;

/** The state of a replay, from which a playback continues at the next record. Times are event times, epoch ms. */
public final class PlaybackState implements Cloneable {
    private static final int NO_TEXT = -1;

    /** Sequence of the desired state that was applied last. */
    long sequence = -1;
    /** The next action. */
    Phase phase = Phase.OPENING;
    /** Why the replay is over; null if there is no reason to report. */
    String reason;
    /** Epoch of the next record. */
    long epoch;
    /** Sequence of the next record in its epoch. */
    long number;
    /** How far timestamps are ahead of event times, ms. */
    long offset;
    /** Timestamp of the newest record, epoch ms; 0 if there is none. */
    long stamp;
    /** Requested beginning of the epoch; null for the replay's beginning. */
    Long start;
    /** Actual beginning of the epoch. */
    long point;
    /** Position after the last event that was played or filtered out. */
    Cursor cursor = Cursor.START;
    /** Reached event time. */
    long position;
    /** Time of the recording's first event. */
    long first;
    /** Time of the recording's last event. */
    long last;
    /** Single steps that are made or obsolete. */
    long steps;
    /** Events played in this epoch. */
    long events;
    /** Primes played in this epoch. */
    long primes;
    /** Stored documents of this epoch without a valid event. */
    long skipped;
    /** Position after the event up to which a paused replay plays to complete a step back; else null. */
    Cursor goal;

    /** The phases of a playback. */
    public enum Phase {
        /** Reads the extent of the recording. */
        OPENING(0),
        /** Plays the states before the point. */
        PRIMING(1),
        PLAYING(2),
        /** Waits until the next pass of a loop may begin. */
        BETWEEN(3),
        ENDED(4),
        STOPPED(5),
        FAILED(6);

        private final int code;

        Phase(int code) {
            this.code = code;
        }

        /** Returns the code of the phase in savepoints, which is never reused. */
        public int code() {
            return code;
        }

        /** @throws IOException if no phase has the code */
        public static Phase of(int code) throws IOException {
            for (Phase phase : values()) {
                if (phase.code == code) {
                    return phase;
                }
            }
            throw new IOException("no phase of a replay has the code " + code);
        }

        public boolean isOver() {
            return this == ENDED || this == STOPPED || this == FAILED;
        }

        /** Returns the state that a status reports. */
        ReplayStatus.State toState(boolean paused) {
            return switch (this) {
                case ENDED -> ReplayStatus.State.ENDED;
                case STOPPED -> ReplayStatus.State.STOPPED;
                case FAILED -> ReplayStatus.State.FAILED;
                default -> paused ? ReplayStatus.State.PAUSED : ReplayStatus.State.RUNNING;
            };
        }
    }

    /** Creates the state of a replay that was never played. */
    public PlaybackState() {}

    /**
     * Creates the state of a replay that no checkpoint contains but that has played before.
     *
     * @param epoch first epoch to use
     * @param stamp minimum timestamp of its records, epoch ms
     */
    public PlaybackState(long epoch, long stamp) {
        this.epoch = epoch;
        this.stamp = stamp;
    }

    public long sequence() {
        return sequence;
    }

    public Phase phase() {
        return phase;
    }

    public long epoch() {
        return epoch;
    }

    public long stamp() {
        return stamp;
    }

    PlaybackState copy() {
        try {
            return (PlaybackState) clone();
        } catch (CloneNotSupportedException e) {
            throw new IllegalStateException(e);
        }
    }

    ReplayStatus.Progress progress(long reached, long lateness, long slip, double rate, String waiting) {
        return new ReplayStatus.Progress(
                epoch, reached, first, last, offset, lateness, slip, rate, events, primes, skipped, waiting);
    }

    /** Enters another phase and clears the requested beginning of the epoch. */
    void enter(Phase next, String why) {
        phase = next;
        reason = why;
        start = null;
    }

    /**
     * @param from epoch ms; null for the replay's beginning
     * @param used greatest epoch that the topic has
     */
    void beginEpoch(Long from, long used) {
        enter(Phase.OPENING, null);
        epoch = Math.max(epoch, used) + 1;
        number = 0;
        start = from;
        cursor = Cursor.START;
        events = 0;
        primes = 0;
        skipped = 0;
        goal = null;
    }

    /** Begins the epoch within the recording. The offset grows if timestamps would step back. */
    void opened(RecordingExtent recordingExtent, DesiredReplay desired) {
        point = point(recordingExtent, desired);
        enter(Phase.PRIMING, null);
        offset = Math.max(offset, stamp - point);
        cursor = point <= recordingExtent.first() ? Cursor.START : Cursor.before(point);
        position = point;
        first = recordingExtent.first();
        last = recordingExtent.last();
    }

    /** Sets the position at which an epoch would have begun whose recording could not be opened. */
    void unopened(DesiredReplay desired) {
        position = clamp(0, start == null ? desired.from(first) : start, Epochs.SPAN - 1);
        offset = Math.max(offset, stamp - position);
    }

    /** Returns the beginning of the epoch: as requested, but within the recording and the replay's range. */
    private long point(RecordingExtent recordingExtent, DesiredReplay desired) {
        long from = desired.from(recordingExtent.first());
        long to = Math.min(recordingExtent.last() + 1, desired.to());
        long min = clamp(0, from, Epochs.SPAN - 1);
        return start == null ? min : clamp(min, start, Math.max(min, Math.min(to, Epochs.SPAN - 1)));
    }

    private static long clamp(long min, long number, long max) {
        return Math.max(min, Math.min(number, max));
    }

    void played(PlaybackRecord playbackRecord) {
        number++;
        offset = playbackRecord.offset();
        stamp = Math.max(stamp, playbackRecord.stamp());
        position = playbackRecord.time();
        if (playbackRecord.kind() == PlaybackRecord.Kind.EVENT) {
            cursor = playbackRecord.event().cursor();
            events++;
        } else if (playbackRecord.kind() == PlaybackRecord.Kind.PRIME) {
            primes++;
        }
    }

    /** Writes the format of savepoints: the members in their order, the phase as its code. */
    public void write(DataOutput out) throws IOException {
        out.writeLong(sequence);
        out.writeByte(phase.code());
        writeText(reason, out);
        out.writeLong(epoch);
        out.writeLong(number);
        out.writeLong(offset);
        out.writeLong(stamp);
        out.writeBoolean(start != null);
        out.writeLong(start == null ? 0 : start);
        out.writeLong(point);
        writeCursor(cursor, out);
        out.writeLong(position);
        out.writeLong(first);
        out.writeLong(last);
        out.writeLong(steps);
        out.writeLong(events);
        out.writeLong(primes);
        out.writeLong(skipped);
        writeCursor(goal == null ? Cursor.START : goal, out);
    }

    public static PlaybackState read(DataInput in) throws IOException {
        PlaybackState state = new PlaybackState();
        state.sequence = in.readLong();
        state.phase = Phase.of(in.readByte());
        state.reason = readText(in);
        state.epoch = in.readLong();
        state.number = in.readLong();
        state.offset = in.readLong();
        state.stamp = in.readLong();
        boolean starts = in.readBoolean();
        long start = in.readLong();
        state.start = starts ? Long.valueOf(start) : null;
        state.point = in.readLong();
        state.cursor = readCursor(in);
        state.position = in.readLong();
        state.first = in.readLong();
        state.last = in.readLong();
        state.steps = in.readLong();
        state.events = in.readLong();
        state.primes = in.readLong();
        state.skipped = in.readLong();
        Cursor goal = readCursor(in);
        state.goal = goal.equals(Cursor.START) ? null : goal;
        return state;
    }

    private static void writeCursor(Cursor cursor, DataOutput out) throws IOException {
        out.writeLong(cursor.time());
        writeText(cursor.id(), out);
    }

    private static Cursor readCursor(DataInput in) throws IOException {
        return new Cursor(in.readLong(), readText(in));
    }

    private static void writeText(String text, DataOutput out) throws IOException {
        byte[] bytes = text == null ? new byte[0] : text.getBytes(StandardCharsets.UTF_8);
        out.writeInt(text == null ? NO_TEXT : bytes.length);
        out.write(bytes);
    }

    private static String readText(DataInput in) throws IOException {
        int length = in.readInt();
        if (length == NO_TEXT) {
            return null;
        }
        byte[] bytes = new byte[length];
        in.readFully(bytes);
        return new String(bytes, StandardCharsets.UTF_8);
    }
}
