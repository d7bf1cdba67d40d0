package io.furrow.connect.sink;

import java.time.Duration;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.Validators;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.model.event.FiwareScope;

/** The options of the sink; throws {@link ConfigException} naming the option where one cannot be used. */
public class NgsiSinkConfig extends AbstractConfig {
    static final String SERVICE = "fiware.service";
    static final String SERVICE_PATH = "fiware.servicepath";
    static final String BATCH_SIZE = "batch.size";
    static final String BATCH_BYTES = "batch.bytes";
    static final String RETRY_BACKOFF = "retry.backoff.ms";

    private final BrokerOptions broker;

    NgsiSinkConfig(Map<String, String> properties) {
        super(definition(), properties);
        broker = new BrokerOptions(this);
    }

    static ConfigDef definition() {
        ConfigDef options = new ConfigDef();
        BrokerOptions.define(options, Optional.empty());
        defineScope(options);
        defineBatches(options);
        definePatience(options);
        return options;
    }

    private static void defineScope(ConfigDef options) {
        String group = "Scope";
        options.define(
                SERVICE,
                Type.STRING,
                "",
                Validators.matching(ChangeReader.SERVICE, "at most 50 of a-z 0-9 _"),
                Importance.MEDIUM,
                "Tenant (Fiware-Service) of records without a header fiware-service; empty for the default tenant.",
                group,
                1,
                Width.MEDIUM,
                "Tenant");
        options.define(
                SERVICE_PATH,
                Type.STRING,
                "/",
                Validators.matching(ChangeReader.SERVICE_PATH, "a path of A-Z a-z 0-9 _ that begins with /"),
                Importance.MEDIUM,
                "Service path (Fiware-Servicepath) of records without a header fiware-servicepath.",
                group,
                2,
                Width.MEDIUM,
                "Service path");
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
    }

    private static void definePatience(ConfigDef options) {
        String group = "Patience";
        options.define(
                RETRY_BACKOFF,
                Type.LONG,
                1_000L,
                Range.between(1, 600_000),
                Importance.LOW,
                "Milliseconds until the same records are tried again when the context broker is away.",
                group,
                1,
                Width.SHORT,
                "Back-off (ms)");
    }

    BrokerOptions broker() {
        return broker;
    }

    /** Where records without headers belong. */
    FiwareScope scope() {
        return FiwareScope.of(getString(SERVICE), getString(SERVICE_PATH));
    }

    Batches batches() {
        return new Batches(getInt(BATCH_SIZE), getLong(BATCH_BYTES));
    }

    Duration retryBackoff() {
        return Duration.ofMillis(getLong(RETRY_BACKOFF));
    }
}
