package io.furrow.connect.source;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

/** How much may wait in memory. */
record PendingOptions(AbstractConfig config) {
    static final String MAX_PENDING_BYTES = "max.pending.bytes";

    private static final int MIB = 1024 * 1024;

    static void define(ConfigDef options) {
        String group = "Pending";
        options.define(
                MAX_PENDING_BYTES,
                Type.LONG,
                64L * MIB,
                Range.atLeast(1),
                Importance.LOW,
                "Bytes of records that may wait for the disk at a time; beyond it there is no room. At least "
                        + SizeOptions.MAX_BODY_BYTES + ".",
                group,
                1,
                Width.SHORT,
                "Pending (bytes)");
    }

    long maxBytes() {
        return config.getLong(MAX_PENDING_BYTES);
    }
}
