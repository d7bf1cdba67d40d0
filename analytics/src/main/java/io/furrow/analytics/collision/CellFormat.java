package io.furrow.analytics.collision;

import java.io.IOException;
import java.util.HashSet;
import java.util.Set;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;

/** How a {@link Cell} is written. */
public final class CellFormat extends Format<Cell> {
    private static final long serialVersionUID = 1L;
    /** Number of members; of each whether it is at home, and the fix in its version 1; whether there is a crowd, and it. */
    private static final int VERSION = 1;

    private static final int FIX_VERSION = 1;
    private static final int PAIR_VERSION = 1;

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
        out.writeBoolean(cell.crowd() != null);
        if (cell.crowd() != null) {
            write(cell.crowd(), out);
        }
    }

    private static void write(Crowd crowd, DataOutputView out) throws IOException {
        out.writeInt(crowd.kept().size());
        for (Pair pair : crowd.kept()) {
            PairFormat.INSTANCE.write(pair, out);
        }
        out.writeInt(crowd.close());
        out.writeBoolean(crowd.over());
        out.writeLong(crowd.reported());
    }

    private static Crowd readCrowd(DataInputView in) throws IOException {
        Set<Pair> kept = new HashSet<>();
        for (int left = in.readInt(); left > 0; left--) {
            kept.add(PairFormat.INSTANCE.read(PAIR_VERSION, in));
        }
        return new Crowd(kept, in.readInt(), in.readBoolean(), in.readLong());
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
        cell.crowd(in.readBoolean() ? readCrowd(in) : null);
        return cell;
    }

    @Override
    public Cell copy(Cell cell) {
        Cell copy = Cell.empty();
        cell.members().forEach(copy::put);
        copy.crowd(cell.crowd() == null ? null : cell.crowd().copy());
        return copy;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
