package io.furrow.connect.source.option;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.OptionGroup;

/** Options for the records that may wait in memory. */
public record PendingOptions(AbstractConfig config) {
    public static final String MAX_PENDING_BYTES = "max.pending.bytes";

    private static final int MIB = 1024 * 1024;

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Pending");
        group.low()
                .number(
                        MAX_PENDING_BYTES,
                        64L * MIB,
                        Range.atLeast(1),
                        "Pending (bytes)",
                        "Bytes of records that may wait for the disk at a time; beyond it, further records wait. At least "
                                + SizeOptions.MAX_BODY_BYTES + ".");
    }

    public long maxBytes() {
        return config.getLong(MAX_PENDING_BYTES);
    }
}
