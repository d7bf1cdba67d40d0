package io.furrow.replay.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;

import org.apache.flink.core.io.SimpleVersionedSerializer;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;

import io.furrow.mission.Cursor;
import io.furrow.replay.playback.PlaybackState;
import io.furrow.replay.playback.PlaybackState.Phase;

/** Writes a {@link ReplaySplit}. */
final class ReplaySplitSerializer implements SimpleVersionedSerializer<ReplaySplit> {
    /** Name, desired record, members of {@link PlaybackState} in their order, the phase by its code. */
    private static final int VERSION = 2;

    private static final int NOTHING = -1;

    @Override
    public int getVersion() {
        return VERSION;
    }

    @Override
    public byte[] serialize(ReplaySplit split) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(512);
        write(split, out);
        return out.getCopyOfBuffer();
    }

    private static void write(ReplaySplit split, DataOutputSerializer out) throws IOException {
        PlaybackState state = split.state();
        writeText(split.replay(), out);
        writeBytes(split.desired(), out);
        out.writeLong(state.sequence());
        out.writeByte(state.phase().code());
        writeText(state.reason(), out);
        out.writeLong(state.epoch());
        out.writeLong(state.number());
        out.writeLong(state.offset());
        out.writeLong(state.stamp());
        out.writeBoolean(state.start() != null);
        out.writeLong(state.start() == null ? 0 : state.start());
        out.writeLong(state.point());
        out.writeLong(state.cursor().time());
        writeText(state.cursor().id(), out);
        out.writeLong(state.position());
        out.writeLong(state.first());
        out.writeLong(state.last());
        out.writeLong(state.steps());
        out.writeLong(state.events());
        out.writeLong(state.primes());
        out.writeLong(state.skipped());
        Cursor goal = state.goal() == null ? Cursor.START : state.goal();
        out.writeLong(goal.time());
        writeText(goal.id(), out);
    }

    @Override
    public ReplaySplit deserialize(int version, byte[] bytes) throws IOException {
        if (version != VERSION) {
            throw new IOException("a replay's state of version " + version + " is unknown, known is " + VERSION
                    + "; start the release that wrote it, or without the savepoint");
        }
        DataInputDeserializer in = new DataInputDeserializer(bytes);
        ReplaySplit split = read(in);
        if (in.available() > 0) {
            throw new IOException(in.available() + " bytes follow the state of replay " + split.replay());
        }
        return split;
    }

    private static ReplaySplit read(DataInputDeserializer in) throws IOException {
        String replay = readText(in);
        byte[] desired = readBytes(in);
        long sequence = in.readLong();
        Phase phase = Phase.of(in.readByte());
        String reason = readText(in);
        long epoch = in.readLong();
        long number = in.readLong();
        long offset = in.readLong();
        long stamp = in.readLong();
        boolean hasStart = in.readBoolean();
        long start = in.readLong();
        return new ReplaySplit(
                replay,
                desired,
                new PlaybackState(
                        sequence,
                        phase,
                        reason,
                        epoch,
                        number,
                        offset,
                        stamp,
                        hasStart ? Long.valueOf(start) : null,
                        in.readLong(),
                        new Cursor(in.readLong(), readText(in)),
                        in.readLong(),
                        in.readLong(),
                        in.readLong(),
                        in.readLong(),
                        in.readLong(),
                        in.readLong(),
                        in.readLong(),
                        goal(in)));
    }

    private static Cursor goal(DataInputDeserializer in) throws IOException {
        Cursor goal = new Cursor(in.readLong(), readText(in));
        return goal.equals(Cursor.START) ? null : goal;
    }

    private static void writeText(String text, DataOutputSerializer out) throws IOException {
        writeBytes(text == null ? null : text.getBytes(StandardCharsets.UTF_8), out);
    }

    private static String readText(DataInputDeserializer in) throws IOException {
        byte[] bytes = readBytes(in);
        return bytes == null ? null : new String(bytes, StandardCharsets.UTF_8);
    }

    private static void writeBytes(byte[] bytes, DataOutputSerializer out) throws IOException {
        if (bytes == null) {
            out.writeInt(NOTHING);
        } else {
            out.writeInt(bytes.length);
            out.write(bytes);
        }
    }

    private static byte[] readBytes(DataInputDeserializer in) throws IOException {
        int length = in.readInt();
        if (length == NOTHING) {
            return null;
        }
        byte[] bytes = new byte[length];
        in.readFully(bytes);
        return bytes;
    }
}
