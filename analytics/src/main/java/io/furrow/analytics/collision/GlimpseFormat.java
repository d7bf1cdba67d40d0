package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Glimpse} is written. */
public final class GlimpseFormat extends Format<Glimpse> {
    private static final long serialVersionUID = 1L;
    /** Both fixes as parts, both versions, whether close. In version 1 fixes are without their version, which was 1. */
    private static final int VERSION = 2;

    @Override
    public Class<Glimpse> type() {
        return Glimpse.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Glimpse glimpse, DataOutputView out) throws IOException {
        PositionFixFormat.INSTANCE.writePart(glimpse.first(), out);
        PositionFixFormat.INSTANCE.writePart(glimpse.second(), out);
        out.writeLong(glimpse.firstVersion());
        out.writeLong(glimpse.secondVersion());
        out.writeBoolean(glimpse.close());
    }

    @Override
    public Glimpse read(int version, DataInputView in) throws IOException {
        if (version < 1 || version > VERSION) {
            throw unknown(version);
        }
        return new Glimpse(
                PositionFixFormat.INSTANCE.readPart(version, in),
                PositionFixFormat.INSTANCE.readPart(version, in),
                in.readLong(),
                in.readLong(),
                in.readBoolean());
    }
}
