package io.furrow.replay.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.List;

import org.apache.flink.core.io.SimpleVersionedSerializer;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;

import io.furrow.replay.playback.PlaybackState;

/** Serializes a {@link ReplaySplit}. */
final class ReplaySplitSerializer implements SimpleVersionedSerializer<ReplaySplit> {
    /** Name, desired record, {@link PlaybackState}. */
    private static final int VERSION = 2;

    @Override
    public int getVersion() {
        return VERSION;
    }

    @Override
    public byte[] serialize(ReplaySplit split) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(512);
        byte[] name = split.replay().getBytes(StandardCharsets.UTF_8);
        for (byte[] each : List.of(name, split.desired())) {
            out.writeInt(each.length);
            out.write(each);
        }
        split.state().write(out);
        return out.getCopyOfBuffer();
    }

    @Override
    public ReplaySplit deserialize(int version, byte[] bytes) throws IOException {
        if (version != VERSION) {
            throw new IOException("unknown version " + version + " of a replay's state, expected " + VERSION
                    + "; start the release that wrote it, or start without the savepoint");
        }
        DataInputDeserializer in = new DataInputDeserializer(bytes);
        String replay = new String(readBytes(in), StandardCharsets.UTF_8);
        ReplaySplit split = new ReplaySplit(replay, readBytes(in), PlaybackState.read(in));
        if (in.available() > 0) {
            throw new IOException(in.available() + " bytes follow the state of replay " + split.replay());
        }
        return split;
    }

    private static byte[] readBytes(DataInputDeserializer in) throws IOException {
        byte[] bytes = new byte[in.readInt()];
        in.readFully(bytes);
        return bytes;
    }
}
