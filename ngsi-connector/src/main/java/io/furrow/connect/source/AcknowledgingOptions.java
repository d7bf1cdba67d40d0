package io.furrow.connect.source;

import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;

/** How long a sender waits, and how much is handed on at a time. */
record AcknowledgingOptions(AbstractConfig config) {
    static final String ACK_TIMEOUT = "ack.timeout.ms";
    static final String BATCH_SIZE = "batch.size";

    private static final long HOUR = Duration.ofHours(1).toMillis();

    static void define(ConfigDef options) {
        String group = "Acknowledging";
        options.define(
                ACK_TIMEOUT,
                Type.LONG,
                10_000L,
                Range.between(1, HOUR),
                Importance.LOW,
                "Milliseconds until a notification that the disk has not taken is answered 503. Longer than the context"
                        + " broker's own patience (Orion: 5 s), so that it counts the failure in its subscription.",
                group,
                1,
                Width.SHORT,
                "Acknowledgement (ms)");
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

    Duration ackTimeout() {
        return Duration.ofMillis(config.getLong(ACK_TIMEOUT));
    }

    int batchSize() {
        return config.getInt(BATCH_SIZE);
    }
}
