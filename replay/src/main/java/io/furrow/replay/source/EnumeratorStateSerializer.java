package io.furrow.replay.source;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.core.io.SimpleVersionedSerializer;
import org.apache.flink.core.memory.DataInputDeserializer;
import org.apache.flink.core.memory.DataOutputSerializer;

/** Serializes {@link EnumeratorState}: version of the splits, their number, then length and bytes of each. */
final class EnumeratorStateSerializer implements SimpleVersionedSerializer<EnumeratorState> {
    private static final int VERSION = 1;

    private final ReplaySplitSerializer splitSerializer = new ReplaySplitSerializer();

    @Override
    public int getVersion() {
        return VERSION;
    }

    @Override
    public byte[] serialize(EnumeratorState replays) throws IOException {
        DataOutputSerializer out = new DataOutputSerializer(64);
        out.writeInt(splitSerializer.getVersion());
        out.writeInt(replays.splits().size());
        for (ReplaySplit split : replays.splits()) {
            byte[] bytes = splitSerializer.serialize(split);
            out.writeInt(bytes.length);
            out.write(bytes);
        }
        return out.getCopyOfBuffer();
    }

    @Override
    public EnumeratorState deserialize(int version, byte[] bytes) throws IOException {
        if (version != VERSION) {
            throw new IOException("unknown version " + version + " of the replays without a reader, expected " + VERSION
                    + "; start the release that wrote them, or start without the savepoint");
        }
        DataInputDeserializer in = new DataInputDeserializer(bytes);
        int splitVersion = in.readInt();
        int count = in.readInt();
        List<ReplaySplit> splits = new ArrayList<>();
        for (int i = 0; i < count; i++) {
            byte[] split = new byte[in.readInt()];
            in.readFully(split);
            splits.add(splitSerializer.deserialize(splitVersion, split));
        }
        if (in.available() > 0) {
            throw new IOException(in.available() + " bytes follow the replays without a reader");
        }
        return new EnumeratorState(splits);
    }
}
