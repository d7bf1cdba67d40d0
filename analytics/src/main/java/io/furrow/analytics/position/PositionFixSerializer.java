package io.furrow.analytics.position;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.VersionedSerializer;

/** Serializes {@link PositionFix}. */
public final class PositionFixSerializer extends VersionedSerializer<PositionFix> {
    public static final PositionFixSerializer INSTANCE = new PositionFixSerializer();

    private static final long serialVersionUID = 1L;
    /** The components in their order. */
    private static final int VERSION = 1;

    @Override
    public Class<PositionFix> type() {
        return PositionFix.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(PositionFix fix, DataOutputView out) throws IOException {
        fix.reporter().write(out);
        out.writeDouble(fix.latitude());
        out.writeDouble(fix.longitude());
        out.writeDouble(fix.speed());
        out.writeDouble(fix.heading());
        out.writeLong(fix.time());
    }

    @Override
    public PositionFix read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new PositionFix(
                DeviceInfo.read(in), in.readDouble(), in.readDouble(), in.readDouble(), in.readDouble(), in.readLong());
    }
}
