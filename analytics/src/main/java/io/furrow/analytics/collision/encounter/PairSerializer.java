package io.furrow.analytics.collision.encounter;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.StringCodec;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link Pair}. */
public final class PairSerializer extends VersionedSerializer<Pair> {

    private static final long serialVersionUID = 1L;
    /** Topic, identities of the first and the second. */
    private static final int VERSION = 1;

    @Override
    public Class<Pair> type() {
        return Pair.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Pair pair, DataOutputView out) throws IOException {
        StringCodec.write(pair.topic(), out);
        StringCodec.write(pair.first(), out);
        StringCodec.write(pair.second(), out);
    }

    @Override
    public Pair read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Pair(StringCodec.read(in), StringCodec.read(in), StringCodec.read(in));
    }
}
