package io.furrow.analytics.collision.encounter;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.position.PositionFixSerializer;
import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link OpenEncounter}. */
public final class OpenEncounterSerializer extends VersionedSerializer<OpenEncounter> {
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
    public void write(OpenEncounter encounter, DataOutputView out) throws IOException {
        out.writeLong(encounter.startTime());
        out.writeDouble(encounter.minDistance());
        out.writeLong(encounter.reported());
        PositionFixSerializer.INSTANCE.writePart(encounter.first(), out);
        PositionFixSerializer.INSTANCE.writePart(encounter.second(), out);
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
