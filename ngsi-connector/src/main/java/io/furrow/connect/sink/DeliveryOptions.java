package io.furrow.connect.sink;

import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

/** How much goes into a request, how many at a time, what is remembered, and how a delivery that fails is tried again. */
record DeliveryOptions(AbstractConfig config) {
    static final String BATCH_SIZE = "batch.size";
    static final String BATCH_BYTES = "batch.bytes";
    static final String PARALLEL = "parallel.requests";
    static final String MAX_KNOWN = "known.attributes.max";
    static final String MAX_KNOWN_AGE = "known.max.age.ms";
    static final String ISOLATE_AFTER = "retry.isolate.after";
    static final String REFUSE_AFTER = "retry.refuse.after";
    static final String RETRY_BACKOFF = "retry.backoff.ms";
    static final String RETRY_BACKOFF_MAX = "retry.backoff.max.ms";

    private static final String RETRIES = "Retries";

    /** Checks what concerns more than one option. */
    DeliveryOptions {
        if (config.getLong(RETRY_BACKOFF_MAX) < config.getLong(RETRY_BACKOFF)) {
            throw new ConfigException(
                    RETRY_BACKOFF_MAX, config.getLong(RETRY_BACKOFF_MAX), "must be at least " + RETRY_BACKOFF);
        }
    }

    static void define(ConfigDef options) {
        defineBatches(options);
        defineKnown(options);
        defineRetries(options);
        defineIsolation(options);
    }

    private static void defineBatches(ConfigDef options) {
        String group = "Batches";
        options.define(
                BATCH_SIZE,
                Type.INT,
                100,
                Range.between(1, 10_000),
                Importance.MEDIUM,
                "Most entities in one request.",
                group,
                1,
                Width.SHORT,
                "Batch");
        options.define(
                BATCH_BYTES,
                Type.LONG,
                900_000L,
                Range.atLeast(1),
                Importance.LOW,
                "Most bytes of entities in one request. Orion refuses bodies over 1 MiB unless started with a higher"
                        + " -inReqPayloadMaxSize.",
                group,
                2,
                Width.SHORT,
                "Batch (bytes)");
        options.define(
                PARALLEL,
                Type.INT,
                2,
                Range.between(1, 64),
                Importance.LOW,
                "Most requests of a task that are under way at a time. They are of different entities, so the order within an"
                        + " entity is kept; more than the cores of the context broker make nothing faster.",
                group,
                3,
                Width.SHORT,
                "Parallel requests");
    }

    private static void defineKnown(ConfigDef options) {
        options.define(
                MAX_KNOWN,
                Type.LONG,
                1_000_000L,
                Range.atLeast(0),
                Importance.LOW,
                "Most attributes, of all entities together, whose event times a task remembers, some 30 bytes each; of"
                        + " entities beyond that, and after a start, the times are read from the context broker.",
                "Memory",
                1,
                Width.SHORT,
                "Known attributes");
        options.define(
                MAX_KNOWN_AGE,
                Type.LONG,
                600_000L,
                Range.between(0, Duration.ofDays(365).toMillis()),
                Importance.LOW,
                "Milliseconds after which the times of an entity are read from the context broker again, before a record of it is"
                        + " written: so long an older value may overwrite a newer one that another task or program wrote."
                        + " 0 reads them for every delivery.",
                "Memory",
                2,
                Width.SHORT,
                "Age of what is known (ms)");
    }

    private static void defineRetries(ConfigDef options) {
        String group = RETRIES;
        options.define(
                RETRY_BACKOFF,
                Type.LONG,
                1_000L,
                Range.between(1, 600_000),
                Importance.LOW,
                "Milliseconds until the same records are tried again when the context broker is away; twice as long after each"
                        + " further failure, and never shorter than its Retry-After says, up to an hour.",
                group,
                1,
                Width.SHORT,
                "Back-off (ms)");
        options.define(
                RETRY_BACKOFF_MAX,
                Type.LONG,
                60_000L,
                Range.between(1, 3_600_000),
                Importance.LOW,
                "Most milliseconds between two tries, where the context broker does not ask for more.",
                group,
                2,
                Width.SHORT,
                "Longest back-off (ms)");
    }

    private static void defineIsolation(ConfigDef options) {
        options.define(
                ISOLATE_AFTER,
                Type.INT,
                5,
                Range.between(0, 1_000_000),
                Importance.LOW,
                "Every so many tries of the same records that the context broker answers 500, batches are halved until the entity"
                        + " that draws it stands alone. If any other record of the delivery is written then, that entity is"
                        + " refused. 0 for never.",
                RETRIES,
                3,
                Width.SHORT,
                "Tries until isolation");
        options.define(
                REFUSE_AFTER,
                Type.INT,
                100,
                Range.between(0, 1_000_000),
                Importance.LOW,
                "Tries after which an entity that draws a 500 alone is refused although no other record of the delivery could be"
                        + " written to show that the context broker works. 100 are about 90 minutes with the default"
                        + " back-off. 0 for never: then such a record waits as long as it takes.",
                RETRIES,
                4,
                Width.SHORT,
                "Tries until refusal");
    }

    Batches batches() {
        return new Batches(config.getInt(BATCH_SIZE), config.getLong(BATCH_BYTES));
    }

    int parallelRequests() {
        return config.getInt(PARALLEL);
    }

    long maxKnownAttributes() {
        return config.getLong(MAX_KNOWN);
    }

    Duration maxKnownAge() {
        return Duration.ofMillis(config.getLong(MAX_KNOWN_AGE));
    }

    Isolation isolation() {
        return new Isolation(config.getInt(ISOLATE_AFTER), config.getInt(REFUSE_AFTER));
    }

    Backoff backoff() {
        return new Backoff(
                Duration.ofMillis(config.getLong(RETRY_BACKOFF)), Duration.ofMillis(config.getLong(RETRY_BACKOFF_MAX)));
    }
}
