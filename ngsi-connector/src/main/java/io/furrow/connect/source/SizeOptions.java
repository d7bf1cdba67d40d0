package io.furrow.connect.source;

import java.util.Map;

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

    /** What a transformation may add to a record, and the batch that it is sent in. */
    static final int ROOM_FOR_TRANSFORMATIONS = 16 * 1024;

    static final String PRODUCER_LIMIT = "producer.override.max.request.size";
    /** Connect's prefix for the admin clients of a connector; with {@code bootstrap.servers} the source has one too. */
    static final String ADMIN_PREFIX = "admin.override.";

    private static final String NEW_TOPIC_LIMIT = "topic.creation.default.max.message.bytes";
    private static final String BOOTSTRAP_SERVERS = ADMIN_PREFIX + "bootstrap.servers";
    private static final int KAFKAS_DEFAULT = 1024 * 1024;
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
                        + " or the broker refuses would stop the task. 0 takes what is less of " + PRODUCER_LIMIT
                        + " and "
                        + NEW_TOPIC_LIMIT + ", 1 MiB where one is absent as it is Kafka's default for both; with "
                        + BOOTSTRAP_SERVERS + " the source asks Kafka for the topic's max.message.bytes instead.",
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
        return bytes > 0
                ? bytes
                : Math.min(limit(config, PRODUCER_LIMIT), topicLimit(config)) - ROOM_FOR_TRANSFORMATIONS;
    }

    private static int topicLimit(AbstractConfig config) {
        return config.originals().containsKey(BOOTSTRAP_SERVERS) ? Integer.MAX_VALUE : limit(config, NEW_TOPIC_LIMIT);
    }

    private static int limit(AbstractConfig config, String option) {
        Object limit = config.originals().getOrDefault(option, KAFKAS_DEFAULT);
        return (Integer) ConfigDef.parseType(option, limit, Type.INT);
    }

    /** Settings of an admin client that may ask for the limits of topics; without servers where it may not. */
    Map<String, Object> admin() {
        return config.originalsWithPrefix(ADMIN_PREFIX);
    }
}
