package io.furrow.connect.source;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.atomic.AtomicLong;

import org.apache.kafka.connect.data.Struct;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.header.Header;
import org.apache.kafka.connect.source.SourceRecord;

import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.record.KafkaRecord;
import io.furrow.connect.repair.ReconcileLoop;
import io.furrow.connect.repair.RecordTracker;
import io.furrow.connect.repair.SubscriptionReconciler;
import io.furrow.connect.repair.TrackedRecord;
import io.furrow.connect.source.journal.JournalRecordCodec;
import io.furrow.connect.source.journal.JournalRecordLog;
import io.furrow.connect.source.journal.RecordLog;
import io.furrow.connect.source.option.SubscriptionOptions;
import io.furrow.connect.subscription.DesiredSubscription;
import io.furrow.connect.subscription.DesiredSubscription.Name;
import io.furrow.connect.subscription.IdPartition;
import io.furrow.connect.subscription.Target;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.file.FileProblem;
import io.furrow.model.ngsi.Entity;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Manages the subscriptions of one task and the repair of missed notifications as configured. Without a context broker
 * or subscriptions in the configuration it does nothing.
 */
final class SubscriptionManager implements AutoCloseable {
    private final NgsiSourceConfig config;
    private final Ledger ledger;
    private final RecordTracker live;
    private final AtomicLong unseen;
    /** Null until it is started. */
    private volatile ReconcileLoop loop;

    /** @param ledger that already counts the records in the journal at the start */
    SubscriptionManager(NgsiSourceConfig config, Ledger ledger) {
        this.config = config;
        this.ledger = ledger;
        this.live = new RecordTracker(config.repair().recentMaxBytes());
        this.unseen = new AtomicLong(config.subscription().enabled() ? ledger.recovered.sum() : 0);
    }

    /** The same log, which tracks appended records for the repair. */
    RecordLog tracked(JournalRecordLog recordLog) {
        return config.subscription().enabled() ? records -> append(records, recordLog) : recordLog;
    }

    private Optional<CompletableFuture<Void>> append(List<KafkaRecord> records, JournalRecordLog recordLog) {
        String subscription = "";
        List<TrackedRecord> covered = new ArrayList<>(records.size());
        for (KafkaRecord record : records) {
            if (record.version() != null) {
                FiwareScope scope = new FiwareScope(
                        record.headers().get(HeaderNames.SERVICE),
                        record.headers().get(HeaderNames.SERVICE_PATH));
                String source = record.headers().get(HeaderNames.CE_SOURCE);
                subscription = source.substring(source.lastIndexOf('/') + 1);
                if (loop == null || loop.covers(scope)) {
                    covered.add(new TrackedRecord(
                            scope.identity(record.version().type(), record.key()),
                            record.headers().get(HeaderNames.CE_ID),
                            record.version().modified(),
                            record.value() == null));
                }
            }
        }
        List<byte[]> payloads = records.stream().map(JournalRecordCodec::write).toList();
        return live.append(subscription, covered, () -> recordLog.append(payloads))
                .map(durable -> durable.thenRun(() -> covered.forEach(this::note)));
    }

    private void note(TrackedRecord record) {
        if (loop != null) {
            loop.note(record.identity(), record.gone());
        }
    }

    /** A notification of a subscription arrived. */
    void arrived(String subscription) {
        live.arrived(subscription);
    }

    /** Registers records that left the journal; the first ones may date from before the start. */
    void handedOn(List<SourceRecord> records) {
        if (unseen.get() > 0) {
            unseen.addAndGet(-records.size());
            for (SourceRecord record : records) {
                restore(record);
            }
        }
    }

    private void restore(SourceRecord record) {
        Header id = record.headers().lastWithName(HeaderNames.CE_ID);
        if (id != null
                && record.key() != null
                && record.topic().equals(config.topics().topic())) {
            FiwareScope scope =
                    new FiwareScope(text(record, HeaderNames.SERVICE), text(record, HeaderNames.SERVICE_PATH));
            String entity = record.key() instanceof byte[] utf8
                    ? new String(utf8, StandardCharsets.UTF_8)
                    : record.key().toString();
            String identity = scope.identity(type(record), entity);
            live.restore(new TrackedRecord(identity, id.value().toString(), Optional.empty(), record.value() == null));
        }
    }

    private static String type(SourceRecord record) {
        if (record.value() == null) {
            return text(record, HeaderNames.ENTITY_TYPE);
        }
        if (record.value() instanceof Struct struct) {
            return struct.getString("type");
        }
        try {
            byte[] json = record.value() instanceof byte[] utf8
                    ? utf8
                    : record.value().toString().getBytes(StandardCharsets.UTF_8);
            return Entity.parse(json).type();
        } catch (UnreadableException e) {
            throw new IllegalStateException("a record that the source made holds no entity", e);
        }
    }

    private static String text(SourceRecord record, String header) {
        Header found = record.headers().lastWithName(header);
        return found == null ? "" : found.value().toString();
    }

    /**
     * Starts to manage the subscriptions on another thread.
     *
     * @param port of the task's listener
     * @param recordLog the intake for repaired records, not the watched one
     */
    void start(int port, JournalRecordLog recordLog) {
        if (!config.subscription().enabled()) {
            return;
        }
        List<DesiredSubscription> subscriptions = new ArrayList<>();
        for (String tenant : config.subscription().tenants()) {
            for (String path : config.subscription().servicePaths()) {
                subscriptions.add(desired(new FiwareScope(tenant, path), port));
            }
        }
        Path folder = config.journal()
                .repairFolder(config.name(), config.broker().url().orElseThrow());
        try {
            loop = ReconcileLoop.start(
                    new BrokerClient(config.broker()
                            .settings()
                            .withMaxAnswerBytes(config.repair().pageMaxBytes()))::send,
                    subscriptions,
                    config.repair().settings(folder, config.entities()),
                    new SubscriptionReconciler.SharedServices(
                            live, new RepairRecordWriter(config.translation(), recordLog, ledger), ledger),
                    config.subscription().checkInterval());
        } catch (IOException e) {
            throw new ConnectException("cannot use " + folder + " (" + FileProblem.of(e) + "); make it writable", e);
        }
    }

    private DesiredSubscription desired(FiwareScope scope, int port) {
        SubscriptionOptions options = config.subscription();
        IdPartition partition = new IdPartition(config.taskIndex(), config.taskCount());
        Name name = new Name(options.description(config.name()), partition, scope);
        return new DesiredSubscription(
                name,
                options.subject(partition.count() > 1 ? Optional.of(partition.pattern()) : Optional.empty()),
                options.content(),
                new Target(options.url(http(), config.listening().host(), port), secret(), options.maxFails()),
                options.pace());
    }

    private String http() {
        return config.tls().isOn() ? "https" : "http";
    }

    /** The current secret; a previous one is only accepted, never sent. */
    private Map<String, String> secret() {
        return config.security().secrets().stream()
                .findFirst()
                .map(secret -> Map.of(config.security().secretHeader(), secret.value()))
                .orElse(Map.of());
    }

    /**
     * Pauses requests to the context broker while the source has no task: another worker may own the connector now,
     * together with its subscriptions.
     */
    void rest(boolean resting) {
        if (loop != null) {
            loop.rest(resting);
        }
    }

    /** Stops all requests to the context broker; the subscriptions stay. */
    @Override
    public void close() {
        if (loop != null) {
            loop.close();
        }
    }
}
