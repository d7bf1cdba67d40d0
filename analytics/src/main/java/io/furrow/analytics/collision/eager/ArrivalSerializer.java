package io.furrow.analytics.collision.eager;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.collision.grid.Presence;
import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.Format;

/** How an {@link Arrival} is written. */
public final class ArrivalSerializer extends Format<Arrival> {
    private static final long serialVersionUID = 1L;
    /** Cell, version, code of the presence, fix as a part. In version 1 fixes are without their version, which was 1. */
    private static final int VERSION = 2;

    @Override
    public Class<Arrival> type() {
        return Arrival.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Arrival arrival, DataOutputView out) throws IOException {
        out.writeLong(arrival.cell());
        out.writeLong(arrival.version());
        out.writeByte(arrival.presence().code());
        PositionFixSerializer.INSTANCE.writePart(arrival.fix(), out);
    }

    @Override
    public Arrival read(int version, DataInputView in) throws IOException {
        if (version < 1 || version > VERSION) {
            throw unknown(version);
        }
        return new Arrival(
                in.readLong(),
                in.readLong(),
                Presence.of(in.readByte()),
                PositionFixSerializer.INSTANCE.readPart(version, in));
    }
}
