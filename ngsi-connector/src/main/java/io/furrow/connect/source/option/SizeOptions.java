package io.furrow.connect.source.option;

import java.util.Map;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;

/** Options for the size of bodies and records. */
public record SizeOptions(AbstractConfig config) {
    public static final String MAX_BODY_BYTES = "max.body.bytes";
    static final String MAX_RECORD_BYTES = "max.record.bytes";

    /** Headers of a record and the bytes that the journal adds. */
    public static final int ROOM_FOR_HEADERS = 64 * 1024;

    /** Bytes that a transformation and the batch in which a record is sent may add. */
    public static final int ROOM_FOR_TRANSFORMATIONS = 16 * 1024;

    public static final String PRODUCER_LIMIT = "producer.override.max.request.size";
    /**
     * Connect's prefix for the admin clients of a connector; with {@code bootstrap.servers} the source creates one too.
     */
    public static final String ADMIN_PREFIX = "admin.override.";

    private static final String NEW_TOPIC_LIMIT = "topic.creation.default.max.message.bytes";
    private static final String BOOTSTRAP_SERVERS = ADMIN_PREFIX + "bootstrap.servers";
    private static final int KAFKAS_DEFAULT = 1024 * 1024;
    private static final int SMALLEST_RECORD_LIMIT = 128 * 1024;
    private static final int MIB = 1024 * 1024;

    public SizeOptions {
        if (maxRecordBytes(config) < SMALLEST_RECORD_LIMIT) {
            throw new ConfigException(
                    MAX_RECORD_BYTES,
                    maxRecordBytes(config),
                    "must be at least " + SMALLEST_RECORD_LIMIT + "; raise it, or " + PRODUCER_LIMIT);
        }
    }

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Sizes");
        group.integer(MAX_BODY_BYTES, 8 * MIB, Range.between(1, 256 * MIB), "Body (bytes)")
                .help("Maximum body of a notification in bytes; the beginning of a larger one becomes a dead letter.");
        group.integer(MAX_RECORD_BYTES, 0, Range.between(0, 1024 * MIB), "Record (bytes)")
                .help("Largest record in bytes; an entity beyond it becomes a dead letter, because a record that the"
                        + " producer or the broker rejects would stop the task. 0 uses the smaller of " + PRODUCER_LIMIT
                        + " and " + NEW_TOPIC_LIMIT + ", 1 MiB for a missing one, which is Kafka's default for both;"
                        + " with " + BOOTSTRAP_SERVERS + " the source asks Kafka for the topic's max.message.bytes"
                        + " instead.");
    }

    public int maxBodyBytes() {
        return config.getInt(MAX_BODY_BYTES);
    }

    public int maxRecordBytes() {
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

    /** Settings of an admin client that reads the limits of topics; without bootstrap servers if it must not. */
    public Map<String, Object> admin() {
        return config.originalsWithPrefix(ADMIN_PREFIX);
    }
}
