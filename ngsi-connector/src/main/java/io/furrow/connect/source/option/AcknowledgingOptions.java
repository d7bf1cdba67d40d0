package io.furrow.connect.source.option;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;

import io.furrow.connect.OptionGroup;

/** Options for the number of records that a poll returns. */
public record AcknowledgingOptions(AbstractConfig config) {
    static final String BATCH_SIZE = "batch.size";

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Acknowledging");
        group.low()
                .integer(
                        BATCH_SIZE,
                        500,
                        Range.between(1, 10_000),
                        "Batch",
                        "Maximum records returned to the worker per poll; a poll does not wait for more records than are"
                                + " available.");
    }

    public int batchSize() {
        return config.getInt(BATCH_SIZE);
    }
}
