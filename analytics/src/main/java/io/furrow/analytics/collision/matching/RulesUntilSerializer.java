package io.furrow.analytics.collision.matching;

import java.io.IOException;

import org.apache.flink.core.memory.DataInputView;
import org.apache.flink.core.memory.DataOutputView;

import io.furrow.flink.format.Format;

/** How {@link RulesUntil} are written. */
public final class RulesUntilSerializer extends Format<RulesUntil> {
    private static final long serialVersionUID = 1L;
    /** The rules in their version 1, the last instant. */
    private static final int VERSION = 1;

    private static final int RULES_VERSION = 1;

    private final KnownRulesSerializer rules = new KnownRulesSerializer();

    @Override
    public Class<RulesUntil> type() {
        return RulesUntil.class;
    }

    @Override
    public int version() {
        return VERSION;
    }

    @Override
    public void write(RulesUntil until, DataOutputView out) throws IOException {
        rules.write(until.rules(), out);
        out.writeLong(until.until());
    }

    @Override
    public RulesUntil read(int version, DataInputView in) throws IOException {
        if (version != VERSION) {
            throw unknown(version);
        }
        return new RulesUntil(rules.read(RULES_VERSION, in), in.readLong());
    }
}
