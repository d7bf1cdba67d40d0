package io.furrow.analytics.collision.grid;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link CellUpdate}. */
public final class CellUpdateSerializer extends VersionedSerializer<CellUpdate> {
    private static final long serialVersionUID = 1L;
    /** Cell, time, code of the presence, fix as a part. */
    private static final int VERSION = 2;

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
        out.writeByte(cellUpdate.cellPresence().code());
        PositionFixSerializer.INSTANCE.writePart(cellUpdate.fix(), out);
    }

    @Override
    public CellUpdate read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new CellUpdate(
                in.readLong(),
                in.readLong(),
                CellPresence.of(in.readByte()),
                PositionFixSerializer.INSTANCE.readPart(in));
    }
}
