package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.regex.Pattern;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.Validators;
import io.furrow.model.topic.Topics;

/** The options of the source; throws {@link ConfigException} naming the option where one cannot be used. */
public class NgsiSourceConfig extends AbstractConfig {
    static final String HOST = "listen.host";
    static final String PORT = "listen.port";
    static final String TOPIC = "topic";
    static final String DEAD_LETTER_TOPIC = "dead.letter.topic";
    static final String EXCLUDE_TYPES = "exclude.types";
    static final String MAX_CLOCK_SKEW = "max.clock.skew.ms";
    static final String MAX_BODY_BYTES = "max.body.bytes";
    static final String MAX_RECORD_BYTES = "max.record.bytes";
    static final String MAX_PENDING_COUNT = "max.pending.count";
    static final String MAX_PENDING_BYTES = "max.pending.bytes";
    static final String ACK_TIMEOUT = "ack.timeout.ms";
    static final String BATCH_SIZE = "batch.size";

    private static final String PRODUCER_LIMIT = "producer.override.max.request.size";
    private static final int PRODUCER_DEFAULT = 1024 * 1024;
    private static final int ROOM_FOR_TRANSFORMATIONS = 16 * 1024;
    private static final int SMALLEST_RECORD_LIMIT = 128 * 1024;
    private static final long HOUR = Duration.ofHours(1).toMillis();
    private static final int MIB = 1024 * 1024;

    NgsiSourceConfig(Map<String, String> properties) {
        super(definition(), properties);
        if (topic().equals(deadLetterTopic())) {
            throw new ConfigException(DEAD_LETTER_TOPIC, deadLetterTopic(), "must differ from " + TOPIC);
        }
        if (maxPendingBytes() < maxBodyBytes()) {
            throw new ConfigException(MAX_PENDING_BYTES, maxPendingBytes(), "must be at least " + MAX_BODY_BYTES);
        }
        if (maxRecordBytes() < SMALLEST_RECORD_LIMIT) {
            throw new ConfigException(
                    MAX_RECORD_BYTES,
                    maxRecordBytes(),
                    "must be at least " + SMALLEST_RECORD_LIMIT + "; raise it, or " + PRODUCER_LIMIT);
        }
    }

    static ConfigDef definition() {
        ConfigDef options = new ConfigDef();
        defineListening(options);
        defineTopics(options);
        defineEntities(options);
        defineSizes(options);
        definePending(options);
        defineAcknowledging(options);
        return options;
    }

    private static void defineListening(ConfigDef options) {
        String group = "Listening";
        options.define(
                HOST,
                Type.STRING,
                "127.0.0.1",
                new ConfigDef.NonEmptyString(),
                Importance.HIGH,
                "Address to listen on for notifications. The default takes them from this machine only; set the address"
                        + " that the context broker reaches otherwise.",
                group,
                1,
                Width.MEDIUM,
                "Address");
        options.define(
                PORT,
                Type.INT,
                8090,
                Range.between(0, 65535),
                Importance.HIGH,
                "TCP port to listen on; 0 takes a free one, which only a test can use.",
                group,
                2,
                Width.SHORT,
                "Port");
    }

    private static void defineTopics(ConfigDef options) {
        String group = "Topics";
        options.define(
                TOPIC,
                Type.STRING,
                Topics.RAW,
                Validators.topic(),
                Importance.HIGH,
                "Topic that every entity of a notification is written to, as normalized NGSI-v2 JSON under its id.",
                group,
                1,
                Width.MEDIUM,
                "Topic");
        options.define(
                DEAD_LETTER_TOPIC,
                Type.STRING,
                "",
                Validators.optionalTopic(),
                Importance.MEDIUM,
                "Topic for what cannot be read, with its original bytes; empty for the topic's name followed by .dead.",
                group,
                2,
                Width.MEDIUM,
                "Dead letters");
    }

    private static void defineEntities(ConfigDef options) {
        String group = "Entities";
        options.define(
                EXCLUDE_TYPES,
                Type.LIST,
                "Analytics:.*,Domain,Mission",
                Validators.patterns(),
                Importance.MEDIUM,
                "Regular expressions separated by commas. An entity whose whole type matches one is dropped and counted."
                        + " Name here what is written into the context broker from Kafka, or it comes back as news.",
                group,
                1,
                Width.LONG,
                "Excluded types");
        options.define(
                MAX_CLOCK_SKEW,
                Type.LONG,
                300_000L,
                Range.between(0, HOUR - 1),
                Importance.MEDIUM,
                "Milliseconds that a device's clock may be ahead, less than an hour. Beyond it the event gets the time of"
                        + " receipt and the device is named in the log.",
                group,
                2,
                Width.SHORT,
                "Clock skew (ms)");
    }

    private static void defineSizes(ConfigDef options) {
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

    private static void definePending(ConfigDef options) {
        String group = "Pending";
        options.define(
                MAX_PENDING_COUNT,
                Type.INT,
                10_000,
                Range.atLeast(1),
                Importance.LOW,
                "Notifications that may wait for Kafka's acknowledgement at a time; the next is answered 503.",
                group,
                1,
                Width.SHORT,
                "Pending");
        options.define(
                MAX_PENDING_BYTES,
                Type.LONG,
                64L * MIB,
                Range.atLeast(1),
                Importance.LOW,
                "Bytes of records that may wait for Kafka's acknowledgement at a time, and as many of bodies whose senders"
                        + " wait for an answer; the next is answered 503. At least " + MAX_BODY_BYTES + ".",
                group,
                2,
                Width.SHORT,
                "Pending (bytes)");
    }

    private static void defineAcknowledging(ConfigDef options) {
        String group = "Acknowledging";
        options.define(
                ACK_TIMEOUT,
                Type.LONG,
                10_000L,
                Range.between(1, HOUR),
                Importance.LOW,
                "Milliseconds until a notification that Kafka has not acknowledged is answered 504. Longer than the"
                        + " context broker's own patience (Orion: 5 s), so that it counts the failure in its subscription.",
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

    String name() {
        return originalsStrings().getOrDefault("name", "ngsi-source");
    }

    String host() {
        return getString(HOST);
    }

    int port() {
        return getInt(PORT);
    }

    String topic() {
        return getString(TOPIC);
    }

    String deadLetterTopic() {
        String topic = getString(DEAD_LETTER_TOPIC);
        return topic.isEmpty() ? Topics.dead(topic()) : topic;
    }

    int maxBodyBytes() {
        return getInt(MAX_BODY_BYTES);
    }

    int maxRecordBytes() {
        int bytes = getInt(MAX_RECORD_BYTES);
        return bytes > 0 ? bytes : producerLimit() - ROOM_FOR_TRANSFORMATIONS;
    }

    private int producerLimit() {
        Object limit = originals().getOrDefault(PRODUCER_LIMIT, PRODUCER_DEFAULT);
        return (Integer) ConfigDef.parseType(PRODUCER_LIMIT, limit, Type.INT);
    }

    int maxPendingCount() {
        return getInt(MAX_PENDING_COUNT);
    }

    long maxPendingBytes() {
        return getLong(MAX_PENDING_BYTES);
    }

    Duration ackTimeout() {
        return Duration.ofMillis(getLong(ACK_TIMEOUT));
    }

    int batchSize() {
        return getInt(BATCH_SIZE);
    }

    /** What the translation of notifications needs. */
    NotificationTranslator.Settings translation() {
        List<Pattern> excluded =
                getList(EXCLUDE_TYPES).stream().map(Pattern::compile).toList();
        Duration skew = Duration.ofMillis(getLong(MAX_CLOCK_SKEW));
        return new NotificationTranslator.Settings(
                name(), topic(), deadLetterTopic(), excluded, skew, maxRecordBytes());
    }
}
