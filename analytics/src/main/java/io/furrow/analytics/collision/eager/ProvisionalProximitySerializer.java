package io.furrow.analytics.collision.eager;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.Format;

/** How a {@link ProvisionalProximity} is written. */
public final class ProvisionalProximitySerializer extends Format<ProvisionalProximity> {
    private static final long serialVersionUID = 1L;
    /** Both fixes as parts, both versions, whether close. In version 1 fixes are without their version, which was 1. */
    private static final int VERSION = 2;

    @Override
    public Class<ProvisionalProximity> type() {
        return ProvisionalProximity.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(ProvisionalProximity glimpse, DataOutputView out) throws IOException {
        PositionFixSerializer.INSTANCE.writePart(glimpse.first(), out);
        PositionFixSerializer.INSTANCE.writePart(glimpse.second(), out);
        out.writeLong(glimpse.firstVersion());
        out.writeLong(glimpse.secondVersion());
        out.writeBoolean(glimpse.close());
    }

    @Override
    public ProvisionalProximity read(int version, DataInputView in) throws IOException {
        if (version < 1 || version > VERSION) {
            throw unknown(version);
        }
        return new ProvisionalProximity(
                PositionFixSerializer.INSTANCE.readPart(version, in),
                PositionFixSerializer.INSTANCE.readPart(version, in),
                in.readLong(),
                in.readLong(),
                in.readBoolean());
    }
}
