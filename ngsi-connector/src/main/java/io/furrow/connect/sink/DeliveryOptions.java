package io.furrow.connect.sink;

import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Validator;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.broker.BrokerBackoff;
import io.furrow.connect.sink.api.Batches;
import io.furrow.connect.sink.api.Isolation;

/** Options for batching, parallelism, caching and retries of a delivery. */
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

    /** Checks constraints between options. */
    DeliveryOptions {
        if (config.getLong(RETRY_BACKOFF_MAX) < config.getLong(RETRY_BACKOFF)) {
            throw new ConfigException(
                    RETRY_BACKOFF_MAX, config.getLong(RETRY_BACKOFF_MAX), "must be at least " + RETRY_BACKOFF);
        }
    }

    static void define(ConfigDef options) {
        defineBatches(new OptionGroup(options, "Batches"));
        defineCache(new OptionGroup(options, "Memory").low());
        defineRetries(new OptionGroup(options, "Retries").low());
    }

    private static void defineBatches(OptionGroup group) {
        group.integer(BATCH_SIZE, 100, Range.between(1, 10_000), "Batch").help("Maximum entities in one request.");
        group.low()
                .number(BATCH_BYTES, 900_000L, Range.atLeast(1), "Batch (bytes)")
                .help("Maximum bytes of entities in one request. Orion rejects bodies over 1 MiB unless started with a"
                        + " higher -inReqPayloadMaxSize.");
        group.low()
                .integer(PARALLEL, 2, Range.between(1, 64), "Parallel requests")
                .help("Maximum concurrent requests of a task. They are for different entities, so the order per entity"
                        + " is preserved; more requests than the context broker has cores bring no speed.");
    }

    private static void defineCache(OptionGroup group) {
        group.number(MAX_KNOWN, 1_000_000L, Range.atLeast(0), "Cached attributes")
                .help("Maximum attributes of all entities whose event times a task caches, about 30 bytes each; the"
                        + " times of further entities, and after a start, are read from the context broker.");
        Validator upToAYear = Range.between(0, Duration.ofDays(365).toMillis());
        group.number(MAX_KNOWN_AGE, 600_000L, upToAYear, "Max. age of cached times (ms)")
                .help("Milliseconds after which the cached times of an entity are read from the context broker again"
                        + " before a record is written: until then an older value may overwrite a newer one of another"
                        + " task or program. 0 reads them for every delivery.");
    }

    private static void defineRetries(OptionGroup group) {
        group.number(RETRY_BACKOFF, 1_000L, Range.between(1, 600_000), "Back-off (ms)")
                .help("Milliseconds until a retry when the context broker is unavailable; doubled after each further"
                        + " failure, and never shorter than its Retry-After says, up to an hour.");
        group.number(RETRY_BACKOFF_MAX, 60_000L, Range.between(1, 3_600_000), "Max. back-off (ms)")
                .help("Maximum milliseconds between two retries, unless the context broker requests more.");
        group.integer(ISOLATE_AFTER, 5, Range.between(0, 1_000_000), "Tries until isolation")
                .help("Number of failed tries (answer 500) of the same records after which batches are halved until the"
                        + " entity that causes it is isolated. If any other record of the delivery is then written,"
                        + " that entity is rejected. 0 for never.");
        group.integer(REFUSE_AFTER, 100, Range.between(0, 1_000_000), "Tries until rejection")
                .help("Tries after which an entity that causes a 500 alone is rejected although no other record of the"
                        + " delivery could be written to show that the context broker works. 100 are about 90 minutes"
                        + " with the default back-off. 0 for never: such a record is then retried indefinitely.");
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

    BrokerBackoff backoff() {
        return new BrokerBackoff(
                Duration.ofMillis(config.getLong(RETRY_BACKOFF)), Duration.ofMillis(config.getLong(RETRY_BACKOFF_MAX)));
    }
}
