package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link CellUpdate} is written. */
public final class CellUpdateFormat extends Format<CellUpdate> {
    private static final long serialVersionUID = 1L;
    /** Cell, time, presence as its ordinal, fix in its version 1. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;
    private static final Presence[] PRESENCES = Presence.values();

    @Override
    public Class<CellUpdate> type() {
        return CellUpdate.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(CellUpdate cellUpdate, DataOutputView out) throws IOException {
        out.writeLong(cellUpdate.cell());
        out.writeLong(cellUpdate.time());
        out.writeByte(cellUpdate.presence().ordinal());
        PositionFixFormat.INSTANCE.write(cellUpdate.fix(), out);
    }

    @Override
    public CellUpdate read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new CellUpdate(
                in.readLong(),
                in.readLong(),
                PRESENCES[in.readByte()],
                PositionFixFormat.INSTANCE.read(FIX_VERSION, in));
    }
}
