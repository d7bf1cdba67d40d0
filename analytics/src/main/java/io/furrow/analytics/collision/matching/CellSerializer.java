package io.furrow.analytics.collision.matching;

import java.io.IOException;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.collision.encounter.Pair;
import io.furrow.analytics.collision.encounter.PairSerializer;
import io.furrow.analytics.position.Device;
import io.furrow.analytics.position.PositionFix;
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
    /** The same with fixes without their version, which was 1. */
    private static final int WITHOUT_VERSIONS = 2;
    /**
     * Number of members; of each whether it is at home, and the fix in its version 1; whether pairs were limited, and then the
     * number of those that were followed, they in their version 1, how many were close, whether some were left out, and when
     * that was emitted.
     */
    private static final int LIMITED_PAIRS = 1;

    private static final int RESIDENT = 1;
    private static final int SHORTLIST = 2;

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
        return switch (version) {
            case LIMITED_PAIRS -> readLimited(in);
            case WITHOUT_VERSIONS -> read(in, fix -> PositionFixSerializer.INSTANCE.read(FIX_VERSION, fix));
            case VERSION -> read(in, PositionFixSerializer.INSTANCE::readPart);
            default -> throw unknown(version);
        };
    }

    /** Reads a fix. */
    private interface Fixes {
        PositionFix read(DataInputView in) throws IOException;
    }

    private static Cell read(DataInputView in, Fixes fixes) throws IOException {
        Cell cell = Cell.empty();
        for (int left = in.readInt(); left > 0; left--) {
            int flags = in.readByte();
            Member member = Member.of(fixes.read(in), (flags & RESIDENT) != 0);
            if ((flags & SHORTLIST) != 0) {
                member.shortlist(readShortlist(in));
            }
            cell.put(member);
        }
        if (in.readBoolean()) {
            cell.report(new CrowdReport(in.readLong(), in.readBoolean(), fixes.read(in)));
        }
        return cell;
    }

    /** The pairs that were followed stand on the shortlist of one of both, until it reports. */
    private static Cell readLimited(DataInputView in) throws IOException {
        List<Member> members = new ArrayList<>();
        for (int left = in.readInt(); left > 0; left--) {
            boolean resident = in.readBoolean();
            members.add(Member.of(PositionFixSerializer.INSTANCE.read(FIX_VERSION, in), resident));
        }
        boolean limited = in.readBoolean();
        Map<Device, List<String>> followed = new HashMap<>();
        for (int left = limited ? in.readInt() : 0; left > 0; left--) {
            Pair pair = PairSerializer.INSTANCE.read(PAIR_VERSION, in);
            followed.computeIfAbsent(new Device(pair.topic(), pair.first()), none -> new ArrayList<>())
                    .add(pair.second());
        }
        if (limited) {
            in.readInt();
            in.readBoolean();
            in.readLong();
        }
        Cell cell = Cell.empty();
        for (Member member : members) {
            member.shortlist(
                    limited ? new Shortlist(followed.getOrDefault(member.fix().device(), List.of())) : null);
            cell.put(member);
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
