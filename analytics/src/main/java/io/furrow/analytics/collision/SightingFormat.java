package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Sighting} is written. */
public final class SightingFormat extends Format<Sighting> {
    private static final long serialVersionUID = 1L;
    /** Both fixes in their version 1, time, change. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;

    @Override
    public Class<Sighting> type() {
        return Sighting.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Sighting sighting, DataOutputView out) throws IOException {
        PositionFixFormat.INSTANCE.write(sighting.first(), out);
        PositionFixFormat.INSTANCE.write(sighting.second(), out);
        out.writeLong(sighting.time());
        out.writeByte(sighting.change());
    }

    @Override
    public Sighting read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Sighting(
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in),
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in),
                in.readLong(),
                in.readByte());
    }
}
