package io.furrow.analytics.collision.matching;

import java.io.IOException;
import java.util.Map;
import java.util.TreeMap;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.Format;
import io.furrow.flink.format.Text;

/** How {@link KnownRules} are written. */
public final class KnownRulesSerializer extends Format<KnownRules> {
    private static final long serialVersionUID = 1L;
    /** Common threshold, number of thresholds of types, each with its types, greatest skew, time-to-live, cell, crowd, zones. */
    private static final int VERSION = 1;

    @Override
    public Class<KnownRules> type() {
        return KnownRules.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(KnownRules rules, DataOutputView out) throws IOException {
        out.writeDouble(rules.thresholds().meters());
        out.writeInt(rules.thresholds().ofTypes().size());
        for (Map.Entry<String, Double> types : rules.thresholds().ofTypes().entrySet()) {
            Text.write(types.getKey(), out);
            out.writeDouble(types.getValue());
        }
        out.writeLong(rules.maxSkewMillis());
        out.writeLong(rules.timeToLiveMillis());
        out.writeDouble(rules.cellMeters());
        out.writeInt(rules.crowd());
        out.writeInt(rules.zones());
    }

    @Override
    public KnownRules read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        double meters = in.readDouble();
        Map<String, Double> ofTypes = new TreeMap<>();
        for (int left = in.readInt(); left > 0; left--) {
            ofTypes.put(Text.read(in), in.readDouble());
        }
        return new KnownRules(
                new Thresholds(meters, ofTypes),
                in.readLong(),
                in.readLong(),
                in.readDouble(),
                in.readInt(),
                in.readInt());
    }
}
