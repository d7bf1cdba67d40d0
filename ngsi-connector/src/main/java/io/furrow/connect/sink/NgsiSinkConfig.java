package io.furrow.connect.sink;

import java.util.Map;
import java.util.Optional;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.sink.api.ContextWriter;
import io.furrow.connect.sink.api.EntityTimesCache;

/**
 * The configuration of the sink connector, one record per group of options. Throws {@link ConfigException} with the
 * name of the invalid option.
 */
class NgsiSinkConfig extends AbstractConfig {
    /** Set by the connector for each task, not by users. */
    static final String TASK_INDEX = "task.index";

    private final BrokerOptions broker;
    private final ApiOptions api;
    private final SinkEntityOptions entities;
    private final DeliveryOptions delivery;

    NgsiSinkConfig(Map<String, String> properties) {
        super(definition(), properties);
        broker = new BrokerOptions(this);
        api = new ApiOptions(this);
        entities = new SinkEntityOptions(this);
        delivery = new DeliveryOptions(this);
    }

    static ConfigDef definition() {
        ConfigDef options = new ConfigDef();
        BrokerOptions.define(options, Optional.empty());
        ApiOptions.define(options);
        SinkEntityOptions.define(options);
        DeliveryOptions.define(options);
        return options;
    }

    String name() {
        return originalsStrings().getOrDefault("name", "ngsi-sink");
    }

    int taskIndex() {
        return Integer.parseInt(originalsStrings().getOrDefault(TASK_INDEX, "0"));
    }

    /** Whether another task may write the same entities. */
    boolean hasSeveralTasks() {
        return !originalsStrings().getOrDefault("tasks.max", "1").strip().equals("1");
    }

    BrokerOptions broker() {
        return broker;
    }

    SinkEntityOptions entities() {
        return entities;
    }

    DeliveryOptions delivery() {
        return delivery;
    }

    /** A writer with an empty cache. */
    ContextWriter writer() {
        BrokerClient client = new BrokerClient(broker.settings());
        EntityTimesCache known =
                new EntityTimesCache(delivery.maxKnownAttributes(), delivery.maxKnownAge(), System::nanoTime);
        return new ContextWriter(
                client, api.api(), known, delivery.batches(), delivery.parallelRequests(), delivery.isolation());
    }
}
