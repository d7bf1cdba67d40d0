package io.furrow.analytics.collision.encounter;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.Format;

/** How a {@link OpenEncounter} is written. */
public final class OpenEncounterSerializer extends Format<OpenEncounter> {
    private static final long serialVersionUID = 1L;
    /** Start, closest distance, newest report, both fixes as parts. */
    private static final int VERSION = 2;

    @Override
    public Class<OpenEncounter> type() {
        return OpenEncounter.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(OpenEncounter meeting, DataOutputView out) throws IOException {
        out.writeLong(meeting.startTime());
        out.writeDouble(meeting.minDistance());
        out.writeLong(meeting.reported());
        PositionFixSerializer.INSTANCE.writePart(meeting.first(), out);
        PositionFixSerializer.INSTANCE.writePart(meeting.second(), out);
    }

    @Override
    public OpenEncounter read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new OpenEncounter(
                in.readLong(),
                in.readDouble(),
                in.readLong(),
                PositionFixSerializer.INSTANCE.readPart(in),
                PositionFixSerializer.INSTANCE.readPart(in));
    }
}
