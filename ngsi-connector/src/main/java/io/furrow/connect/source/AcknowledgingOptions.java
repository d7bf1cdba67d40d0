package io.furrow.connect.source;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

/** How much is handed on at a time. */
record AcknowledgingOptions(AbstractConfig config) {
    static final String BATCH_SIZE = "batch.size";

    static void define(ConfigDef options) {
        String group = "Acknowledging";
        options.define(
                BATCH_SIZE,
                Type.INT,
                500,
                Range.between(1, 10_000),
                Importance.LOW,
                "Most records handed to the worker at a time; it does not wait for more than are there.",
                group,
                2,
                Width.SHORT,
                "Batch");
    }

    int batchSize() {
        return config.getInt(BATCH_SIZE);
    }
}
