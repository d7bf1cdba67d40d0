package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Glimpse} is written. */
public final class GlimpseFormat extends Format<Glimpse> {
    private static final long serialVersionUID = 1L;
    /** Both fixes in their version 1, both versions, whether close. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;

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
        PositionFixFormat.INSTANCE.write(glimpse.first(), out);
        PositionFixFormat.INSTANCE.write(glimpse.second(), out);
        out.writeLong(glimpse.firstVersion());
        out.writeLong(glimpse.secondVersion());
        out.writeBoolean(glimpse.close());
    }

    @Override
    public Glimpse read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Glimpse(
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in),
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in),
                in.readLong(),
                in.readLong(),
                in.readBoolean());
    }
}
