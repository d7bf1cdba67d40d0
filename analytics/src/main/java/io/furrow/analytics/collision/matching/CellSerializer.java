package io.furrow.analytics.collision.matching;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.StringCodec;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link Cell}. */
public final class CellSerializer extends VersionedSerializer<Cell> {
    private static final long serialVersionUID = 1L;
    /**
     * Number of members; of each a byte of {@link #RESIDENT} and {@link #SHORTLIST}, the fix as a part, and its shortlist; whether
     * there is a crowd report, its time, whether there was a crowd, and its witness as a part.
     */
    private static final int VERSION = 3;

    private static final int RESIDENT = 1;
    private static final int SHORTLIST = 2;

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
        for (CellEntry cellEntry : cell.members()) {
            out.writeByte((cellEntry.resident() ? RESIDENT : 0) | (cellEntry.shortlist() == null ? 0 : SHORTLIST));
            PositionFixSerializer.INSTANCE.writePart(cellEntry.fix(), out);
            if (cellEntry.shortlist() != null) {
                write(cellEntry.shortlist(), out);
            }
        }
        out.writeBoolean(cell.report() != null);
        if (cell.report() != null) {
            out.writeLong(cell.report().time());
            out.writeBoolean(cell.report().over());
            PositionFixSerializer.INSTANCE.writePart(cell.report().witness(), out);
        }
    }

    public static void write(NearestNeighbors list, DataOutputView out) throws IOException {
        out.writeInt(list.identities().size());
        for (String identity : list.identities()) {
            StringCodec.write(identity, out);
        }
    }

    public static NearestNeighbors readShortlist(DataInputView in) throws IOException {
        List<String> identities = new ArrayList<>();
        for (int left = in.readInt(); left > 0; left--) {
            identities.add(StringCodec.read(in));
        }
        return new NearestNeighbors(identities);
    }

    @Override
    public Cell read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        Cell cell = Cell.empty();
        for (int left = in.readInt(); left > 0; left--) {
            int flags = in.readByte();
            CellEntry cellEntry = CellEntry.of(PositionFixSerializer.INSTANCE.readPart(in), (flags & RESIDENT) != 0);
            if ((flags & SHORTLIST) != 0) {
                cellEntry.shortlist(readShortlist(in));
            }
            cell.put(cellEntry);
        }
        if (in.readBoolean()) {
            cell.report(new CrowdReport(in.readLong(), in.readBoolean(), PositionFixSerializer.INSTANCE.readPart(in)));
        }
        return cell;
    }

    @Override
    public Cell copy(Cell cell) {
        Cell copy = Cell.empty();
        cell.members().forEach(cellEntry -> copy.put(cellEntry.copy()));
        copy.report(cell.report());
        return copy;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
