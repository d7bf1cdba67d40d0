package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Cell} is written. */
public final class CellFormat extends Format<Cell> {
    private static final long serialVersionUID = 1L;
    /** Number of members; of each whether it is at home, and the fix in its version 1. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;

    @Override
    public Class<Cell> type() {
        return Cell.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Cell cell, DataOutputView out) throws IOException {
        out.writeInt(cell.members().size());
        for (Member member : cell.members()) {
            out.writeBoolean(member.resident());
            PositionFixFormat.INSTANCE.write(member.fix(), out);
        }
    }

    @Override
    public Cell read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        Cell cell = Cell.empty();
        for (int left = in.readInt(); left > 0; left--) {
            boolean resident = in.readBoolean();
            cell.put(Member.of(PositionFixFormat.INSTANCE.read(FIX_VERSION, in), resident));
        }
        return cell;
    }

    @Override
    public Cell copy(Cell cell) {
        Cell copy = Cell.empty();
        cell.members().forEach(copy::put);
        return copy;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
