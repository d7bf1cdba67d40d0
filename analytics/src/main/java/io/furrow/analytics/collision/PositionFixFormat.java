package io.furrow.analytics.collision;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.analytics.format.Format;
import io.furrow.analytics.format.Text;

/** How a {@link PositionFix} is written. */
public final class PositionFixFormat extends Format<PositionFix> {
    static final PositionFixFormat INSTANCE = new PositionFixFormat();

    private static final long serialVersionUID = 1L;
    /** The components in their order; of an id that the identity ends with only its length, else -1 before it. */
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
        Text.write(fix.topic(), out);
        Text.write(fix.identity(), out);
        writeId(fix, out);
        Text.write(fix.type(), out);
        Text.write(fix.mission(), out);
        Text.write(fix.carrier(), out);
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
        String topic = Text.read(in);
        String identity = Text.read(in);
        String id = readId(identity, in);
        return new PositionFix(
                topic,
                identity,
                id,
                Text.read(in),
                Text.read(in),
                Text.read(in),
                in.readDouble(),
                in.readDouble(),
                in.readDouble(),
                in.readDouble(),
                in.readLong());
    }

    private static void writeId(PositionFix fix, DataOutputView out) throws IOException {
        if (fix.identity().endsWith(fix.id())) {
            out.writeInt(fix.id().length());
        } else {
            out.writeInt(-1);
            Text.write(fix.id(), out);
        }
    }

    private static String readId(String identity, DataInputView in) throws IOException {
        int length = in.readInt();
        return length < 0 ? Text.read(in) : Text.shared(identity.substring(identity.length() - length));
    }
}
