package io.furrow.analytics.collision.matching;

import java.io.IOException;
import java.util.ArrayList;
import java.util.List;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.Format;
import io.furrow.flink.format.Text;

/** How a {@link Cell} is written. */
public final class CellSerializer extends Format<Cell> {
    private static final long serialVersionUID = 1L;
    /**
     * Number of members; of each a byte of {@link #RESIDENT} and {@link #SHORTLIST}, the fix as a part, and its shortlist; whether
     * something was notified of crowds, and when, whether one was there, and its witness as a part.
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
        for (Member member : cell.members()) {
            out.writeByte((member.resident() ? RESIDENT : 0) | (member.shortlist() == null ? 0 : SHORTLIST));
            PositionFixSerializer.INSTANCE.writePart(member.fix(), out);
            if (member.shortlist() != null) {
                write(member.shortlist(), out);
            }
        }
        out.writeBoolean(cell.report() != null);
        if (cell.report() != null) {
            out.writeLong(cell.report().time());
            out.writeBoolean(cell.report().over());
            PositionFixSerializer.INSTANCE.writePart(cell.report().witness(), out);
        }
    }

    public static void write(Shortlist list, DataOutputView out) throws IOException {
        out.writeInt(list.identities().size());
        for (String identity : list.identities()) {
            Text.write(identity, out);
        }
    }

    public static Shortlist readShortlist(DataInputView in) throws IOException {
        List<String> identities = new ArrayList<>();
        for (int left = in.readInt(); left > 0; left--) {
            identities.add(Text.read(in));
        }
        return new Shortlist(identities);
    }

    @Override
    public Cell read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        Cell cell = Cell.empty();
        for (int left = in.readInt(); left > 0; left--) {
            int flags = in.readByte();
            Member member = Member.of(PositionFixSerializer.INSTANCE.readPart(in), (flags & RESIDENT) != 0);
            if ((flags & SHORTLIST) != 0) {
                member.shortlist(readShortlist(in));
            }
            cell.put(member);
        }
        if (in.readBoolean()) {
            cell.report(new CrowdReport(in.readLong(), in.readBoolean(), PositionFixSerializer.INSTANCE.readPart(in)));
        }
        return cell;
    }

    @Override
    public Cell copy(Cell cell) {
        Cell copy = Cell.empty();
        cell.members().forEach(member -> copy.put(member.copy()));
        copy.report(cell.report());
        return copy;
    }

    @Override
    public boolean isImmutable() {
        return false;
    }
}
