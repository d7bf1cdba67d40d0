package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How an {@link Arrival} is written. */
public final class ArrivalFormat extends Format<Arrival> {
    private static final long serialVersionUID = 1L;
    /** Cell, version, presence as its ordinal, fix in its version 1. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;
    private static final Presence[] PRESENCES = Presence.values();

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
        out.writeByte(arrival.presence().ordinal());
        PositionFixFormat.INSTANCE.write(arrival.fix(), out);
    }

    @Override
    public Arrival read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new Arrival(
                in.readLong(),
                in.readLong(),
                PRESENCES[in.readByte()],
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in));
    }
}
