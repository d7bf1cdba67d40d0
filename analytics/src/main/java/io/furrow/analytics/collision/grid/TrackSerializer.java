package io.furrow.analytics.collision.grid;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFix;
import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link Track}. */
public final class TrackSerializer extends VersionedSerializer<Track> {
    private static final long serialVersionUID = 1L;
    /** The fix as a part, number of cells, cells. */
    private static final int VERSION = 2;

    @Override
    public Class<Track> type() {
        return Track.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(Track track, DataOutputView out) throws IOException {
        PositionFixSerializer.INSTANCE.writePart(track.last(), out);
        out.writeInt(track.cells().length);
        for (long cell : track.cells()) {
            out.writeLong(cell);
        }
    }

    @Override
    public Track read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        PositionFix last = PositionFixSerializer.INSTANCE.readPart(in);
        long[] cells = new long[in.readInt()];
        for (int i = 0; i < cells.length; i++) {
            cells[i] = in.readLong();
        }
        return new Track(last, cells);
    }
}
