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

/** Where a replay is; with a copy of it a playback continues at the next record. Times are event times, epoch ms. */
public final class PlaybackState implements Cloneable {
    private static final int NO_TEXT = -1;

    /** Of the desired replay that was applied last. */
    long sequence = -1;
    /** What is to be done next. */
    Phase phase = Phase.OPENING;
    /** Why it is over; null if that needs no reason. */
    String reason;
    /** Of the next record. */
    long epoch;
    /** Sequence of the next record in its epoch. */
    long number;
    /** Ms that timestamps are ahead of event times. */
    long offset;
    /** Timestamp of the newest record, epoch ms; 0 if there is none. */
    long stamp;
    /** At which the epoch shall begin; null for the replay's beginning. */
    Long start;
    /** At which the epoch begins, and from which on its event time counts. */
    long point;
    /** After the last event that was played or left out. */
    Cursor cursor = Cursor.START;
    /** That is reached. */
    long position;
    /** Of the recording's first event. */
    long first;
    /** Of the recording's last event. */
    long last;
    /** Single steps that are done or obsolete. */
    long steps;
    /** Played in this epoch. */
    long events;
    /** Played in this epoch. */
    long primes;
    /** Stored documents of this epoch that hold no event. */
    long skipped;
    /** After the event up to which a step back has to play, though the replay is held; null if none has. */
    Cursor goal;

    /** What a playback is about. */
    public enum Phase {
        /** Learns what the recording spans. */
        OPENING(0),
        /** Plays what is known before the point. */
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

        /** By which savepoints name it; never given to another phase. */
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

        /** How a status calls it. */
        ReplayStatus.State told(boolean held) {
            return switch (this) {
                case ENDED -> ReplayStatus.State.ENDED;
                case STOPPED -> ReplayStatus.State.STOPPED;
                case FAILED -> ReplayStatus.State.FAILED;
                default -> held ? ReplayStatus.State.PAUSED : ReplayStatus.State.RUNNING;
            };
        }
    }

    /** Of a replay that was never played. */
    public PlaybackState() {}

    /**
     * Of a replay of which nothing is known but what is on its topic.
     *
     * @param epoch to begin with
     * @param stamp epoch ms below which its records' timestamps must not be
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

    /** On to another phase, in which nothing is asked of the next epoch. */
    void enter(Phase next, String why) {
        phase = next;
        reason = why;
        start = null;
    }

    /**
     * @param from epoch ms; null for the replay's beginning
     * @param used greatest epoch that is known to be used
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

    /** The offset grows where timestamps would step back. */
    void opened(RecordingExtent recordingExtent, DesiredReplay desired) {
        point = point(recordingExtent, desired);
        enter(Phase.PRIMING, null);
        offset = Math.max(offset, stamp - point);
        cursor = point <= recordingExtent.first() ? Cursor.START : Cursor.before(point);
        position = point;
        first = recordingExtent.first();
        last = recordingExtent.last();
    }

    /** The epoch would have begun there, as far as that is known. */
    void unopened(DesiredReplay desired) {
        position = within(0, start == null ? desired.from(first) : start, Epochs.SPAN - 1);
        offset = Math.max(offset, stamp - position);
    }

    /** Where the epoch begins: as asked for, but within the recording and what is requested of it. */
    private long point(RecordingExtent recordingExtent, DesiredReplay desired) {
        long from = desired.from(recordingExtent.first());
        long to = Math.min(recordingExtent.last() + 1, desired.to());
        long least = within(0, from, Epochs.SPAN - 1);
        return start == null ? least : within(least, start, Math.max(least, Math.min(to, Epochs.SPAN - 1)));
    }

    private static long within(long least, long number, long most) {
        return Math.max(least, Math.min(number, most));
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

    /** As savepoints hold it: its members in their order, the phase by its code. */
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
