package io.furrow.connect.source;

import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.source.journal.AcknowledgedRecords;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.connect.source.notification.NotificationTranslator;
import io.furrow.connect.source.option.AccessOptions;
import io.furrow.connect.source.option.EntityOptions;
import io.furrow.connect.source.option.JournalOptions;
import io.furrow.connect.source.option.ListeningOptions;
import io.furrow.connect.source.option.OverloadOptions;
import io.furrow.connect.source.option.RecordOptions;
import io.furrow.connect.source.option.RepairOptions;
import io.furrow.connect.source.option.SecurityOptions;
import io.furrow.connect.source.option.SizeOptions;
import io.furrow.connect.source.option.SubscriptionOptions;
import io.furrow.connect.source.option.TlsOptions;
import io.furrow.connect.source.option.TopicOptions;
import io.furrow.connect.subscription.IdPartition;
import io.furrow.http.AccessRule;

/**
 * The configuration of the source connector, one record per group of options. Throws {@link ConfigException} with the
 * name of the invalid option. Each group defines its options and validates them on construction; constraints between
 * two groups are validated here.
 */
public class NgsiSourceConfig extends AbstractConfig {
    /** Set by the connector for each task, not by users. */
    static final String TASK_INDEX = "task.index";

    static final String TASK_COUNT = "task.count";

    private static final int LAST_PORT = 65535;

    private final ListeningOptions listening;
    private final TopicOptions topics;
    private final RecordOptions records;
    private final EntityOptions entities;
    private final SizeOptions sizes;
    private final JournalOptions journal;
    private final OverloadOptions overload;
    private final AccessOptions access;
    private final SecurityOptions security;
    private final TlsOptions tls;
    private final BrokerOptions broker;
    private final SubscriptionOptions subscription;
    private final RepairOptions repair;

    public NgsiSourceConfig(Map<String, String> properties) {
        super(definition(), properties);
        listening = new ListeningOptions(this, taskIndex());
        topics = new TopicOptions(this);
        records = new RecordOptions(this);
        entities = new EntityOptions(this);
        sizes = new SizeOptions(this);
        journal = new JournalOptions(this);
        overload = new OverloadOptions(this);
        access = new AccessOptions(this);
        security = new SecurityOptions(this);
        tls = new TlsOptions(this);
        broker = new BrokerOptions(this);
        subscription = new SubscriptionOptions(this);
        repair = new RepairOptions(this);
        checkPorts();
        checkSizes();
        checkSubscription();
    }

    private int tasks() {
        return Integer.parseInt(
                originalsStrings().getOrDefault("tasks.max", "1").strip());
    }

    private void checkPorts() {
        int tasks = tasks();
        if (listening.firstPort() + tasks - 1 > LAST_PORT) {
            throw new ConfigException(
                    ListeningOptions.PORT,
                    listening.firstPort(),
                    "task i listens on " + ListeningOptions.PORT + " + i, and there are " + tasks + " tasks; lower it");
        }
        int port = listening.firstPort();
        int health = listening.firstHealthPort();
        if (health + tasks - 1 > LAST_PORT || health > 0 && port > 0 && Math.abs(health - port) < tasks) {
            throw new ConfigException(
                    ListeningOptions.HEALTH_PORT,
                    health,
                    "task i takes this port + i, and there are " + tasks + " tasks; it must not meet "
                            + ListeningOptions.PORT + " + i, nor pass " + LAST_PORT);
        }
    }

    private void checkSizes() {
        if (overload.memoryBytes() < sizes.maxBodyBytes()) {
            throw new ConfigException(
                    OverloadOptions.MEMORY, overload.memoryBytes(), "must be at least " + SizeOptions.MAX_BODY_BYTES);
        }
        if (listening.requestTimeout().compareTo(overload.hold()) <= 0) {
            throw new ConfigException(
                    ListeningOptions.REQUEST_TIMEOUT,
                    listening.requestTimeout().toMillis(),
                    "must be more than " + OverloadOptions.HOLD);
        }
        if (journal.maxPendingBytes() < sizes.maxBodyBytes()) {
            throw new ConfigException(
                    JournalOptions.MAX_PENDING_BYTES,
                    journal.maxPendingBytes(),
                    "must be at least " + SizeOptions.MAX_BODY_BYTES);
        }
        long room = journalSettings().largestAppend() - SizeOptions.ROOM_FOR_HEADERS;
        if (sizes.maxBodyBytes() > room) {
            throw new ConfigException(
                    SizeOptions.MAX_BODY_BYTES,
                    sizes.maxBodyBytes(),
                    "a journal of " + journal.maxBytes() + " bytes never has room for it; lower it to " + room
                            + " at most, or raise " + JournalOptions.MAX_BYTES);
        }
    }

    private void checkSubscription() {
        int tasks = tasks();
        if (!subscription.enabled()) {
            return;
        }
        if (tasks > IdPartition.MAX) {
            throw new ConfigException(
                    "tasks.max",
                    tasks,
                    "the ids can be divided among " + IdPartition.MAX + " tasks at most; lower it, or set "
                            + SubscriptionOptions.ENABLED + "=false");
        }
        if (tasks > 1) {
            subscription.requireAnyId();
        }
        subscription.requireAddress(listening.host());
    }

    static ConfigDef definition() {
        ConfigDef options = new ConfigDef();
        ListeningOptions.define(options);
        TopicOptions.define(options);
        RecordOptions.define(options);
        EntityOptions.define(options);
        SizeOptions.define(options);
        JournalOptions.define(options);
        OverloadOptions.define(options);
        AccessOptions.define(options);
        SecurityOptions.define(options);
        TlsOptions.define(options);
        BrokerOptions.define(
                options,
                Optional.of(
                        "Empty if subscriptions are managed elsewhere: the source then creates none and cannot repair"
                                + " missed notifications."));
        SubscriptionOptions.define(options);
        RepairOptions.define(options);
        return options;
    }

    String name() {
        return originalsStrings().getOrDefault("name", "ngsi-source");
    }

    /** The index of this task, from 0. */
    int taskIndex() {
        return Integer.parseInt(originalsStrings().getOrDefault(TASK_INDEX, "0"));
    }

    /** The number of tasks of the connector. */
    int taskCount() {
        return Integer.parseInt(originalsStrings().getOrDefault(TASK_COUNT, "1"));
    }

    ListeningOptions listening() {
        return listening;
    }

    TopicOptions topics() {
        return topics;
    }

    SourceRecords records() {
        return new SourceRecords(records.keys(), records.values());
    }

    EntityOptions entities() {
        return entities;
    }

    SizeOptions sizes() {
        return sizes;
    }

    JournalOptions journal() {
        return journal;
    }

    OverloadOptions overload() {
        return overload;
    }

    /** The rule by which requests are accepted. */
    AccessRule accessRule() {
        return AccessRule.allowing(access.allowed(), AccessOptions.NAMES)
                .servedAs(listening.host())
                .servedAt(subscription.url("http", listening.host(), listening.firstPort()))
                .withProbes("/health");
    }

    public SecurityOptions security() {
        return security;
    }

    TlsOptions tls() {
        return tls;
    }

    BrokerOptions broker() {
        return broker;
    }

    public SubscriptionOptions subscription() {
        return subscription;
    }

    RepairOptions repair() {
        return repair;
    }

    JournalSettings journalSettings() {
        return JournalSettings.of(journal.maxBytes(), journal.maxPendingBytes(), journal.minFreeBytes());
    }

    /** The protection against a Kafka that loses acknowledged records; transforms may change a record's value or topic. */
    TaskJournals.Safety safety() {
        Map<String, Object> client = sizes.admin();
        boolean isVerifiable = client.containsKey("bootstrap.servers")
                && String.valueOf(originals().getOrDefault("transforms", "")).isBlank();
        return new TaskJournals.Safety(
                journal.retention(),
                isVerifiable
                        ? new AcknowledgedRecords(client, List.of(topics.topic(), topics.deadLetterTopic()))
                        : TaskJournals.Verification.NONE);
    }

    /** The settings of the translation of notifications. */
    public NotificationTranslator.Settings translation() {
        return new NotificationTranslator.Settings(
                name(),
                topics.topic(),
                topics.deadLetterTopic(),
                entities.excludedTypes(),
                entities.eventTimes(),
                sizes.maxRecordBytes(),
                journalSettings().largestAppend());
    }
}
