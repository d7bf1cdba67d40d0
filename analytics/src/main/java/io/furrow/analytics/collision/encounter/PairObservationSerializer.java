package io.furrow.analytics.collision.encounter;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link PairObservation}. */
public final class PairObservationSerializer extends VersionedSerializer<PairObservation> {
    private static final long serialVersionUID = 1L;
    /** Both fixes as parts, time, change. */
    private static final int VERSION = 2;

    @Override
    public Class<PairObservation> type() {
        return PairObservation.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(PairObservation observation, DataOutputView out) throws IOException {
        PositionFixSerializer.INSTANCE.writePart(observation.first(), out);
        PositionFixSerializer.INSTANCE.writePart(observation.second(), out);
        out.writeLong(observation.time());
        out.writeByte(observation.change());
    }

    @Override
    public PairObservation read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new PairObservation(
                PositionFixSerializer.INSTANCE.readPart(in),
                PositionFixSerializer.INSTANCE.readPart(in),
                in.readLong(),
                in.readByte());
    }
}
