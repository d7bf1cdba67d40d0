package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Sighting} is written. */
public final class SightingFormat extends Format<Sighting> {
    private static final long serialVersionUID = 1L;
    /** Both fixes as parts, time, change. In version 1 fixes are without their version, which was 1. */
    private static final int VERSION = 2;

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
        PositionFixFormat.INSTANCE.writePart(sighting.first(), out);
        PositionFixFormat.INSTANCE.writePart(sighting.second(), out);
        out.writeLong(sighting.time());
        out.writeByte(sighting.change());
    }

    @Override
    public Sighting read(int version, DataInputView in) throws IOException {
        if (version < 1 || version > VERSION) {
            throw unknown(version);
        }
        return new Sighting(
                PositionFixFormat.INSTANCE.readPart(version, in),
                PositionFixFormat.INSTANCE.readPart(version, in),
                in.readLong(),
                in.readByte());
    }
}
