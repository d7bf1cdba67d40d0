package io.furrow.connect.source;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

/** How large a body and a record may be. */
record SizeOptions(AbstractConfig config) {
    static final String MAX_BODY_BYTES = "max.body.bytes";
    static final String MAX_RECORD_BYTES = "max.record.bytes";

    /** Of a record, and what the journal adds. */
    static final int ROOM_FOR_HEADERS = 64 * 1024;

    private static final String PRODUCER_LIMIT = "producer.override.max.request.size";
    private static final int PRODUCER_DEFAULT = 1024 * 1024;
    private static final int ROOM_FOR_TRANSFORMATIONS = 16 * 1024;
    private static final int SMALLEST_RECORD_LIMIT = 128 * 1024;
    private static final int MIB = 1024 * 1024;

    SizeOptions {
        if (maxRecordBytes(config) < SMALLEST_RECORD_LIMIT) {
            throw new ConfigException(
                    MAX_RECORD_BYTES,
                    maxRecordBytes(config),
                    "must be at least " + SMALLEST_RECORD_LIMIT + "; raise it, or " + PRODUCER_LIMIT);
        }
    }

    static void define(ConfigDef options) {
        String group = "Sizes";
        options.define(
                MAX_BODY_BYTES,
                Type.INT,
                8 * MIB,
                Range.between(1, 256 * MIB),
                Importance.MEDIUM,
                "Largest body of a notification in bytes; of a larger one the beginning becomes a dead letter.",
                group,
                1,
                Width.SHORT,
                "Body (bytes)");
        options.define(
                MAX_RECORD_BYTES,
                Type.INT,
                0,
                Range.between(0, 1024 * MIB),
                Importance.MEDIUM,
                "Largest record in bytes; an entity beyond it becomes a dead letter, because a record that the producer"
                        + " or the broker refuses would stop the task. 0 derives it from " + PRODUCER_LIMIT
                        + " of this connector, or from Kafka's 1 MiB. The broker's message.max.bytes must allow it too.",
                group,
                2,
                Width.SHORT,
                "Record (bytes)");
    }

    int maxBodyBytes() {
        return config.getInt(MAX_BODY_BYTES);
    }

    int maxRecordBytes() {
        return maxRecordBytes(config);
    }

    private static int maxRecordBytes(AbstractConfig config) {
        int bytes = config.getInt(MAX_RECORD_BYTES);
        return bytes > 0 ? bytes : producerLimit(config) - ROOM_FOR_TRANSFORMATIONS;
    }

    private static int producerLimit(AbstractConfig config) {
        Object limit = config.originals().getOrDefault(PRODUCER_LIMIT, PRODUCER_DEFAULT);
        return (Integer) ConfigDef.parseType(PRODUCER_LIMIT, limit, Type.INT);
    }
}
