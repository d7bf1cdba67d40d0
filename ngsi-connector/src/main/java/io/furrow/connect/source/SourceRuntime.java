package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.Timer;
import java.util.TimerTask;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.apache.kafka.connect.errors.ConnectException;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.ledger.LedgerBean;
import io.furrow.connect.source.journal.JournalRecordLog;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.connect.source.option.JournalOptions;

/**
 * Receives notifications and writes them to a journal. It does not need Kafka and can be passed from one task to the next.
 *
 * @param config of the task that opened it
 */
record SourceRuntime(
        NgsiSourceConfig config,
        TaskJournals journals,
        SubscriptionManager subscriptions,
        NotificationEndpoint endpoint,
        Ledger ledger,
        LedgerBean bean)
        implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(SourceRuntime.class);
    private static final Duration BIND_TIMEOUT = Duration.ofSeconds(10);

    /**
     * The sources that run without a task, by connector and task. Static, because Connect creates new tasks, and only the
     * process outlives a task: a distributed worker that does not reach its group's coordinator for
     * {@code heartbeat.interval.ms} stops its tasks, and restarts them when Kafka is back. Meanwhile the source accepts the
     * notifications, which a context broker would not send again.
     */
    private static final Map<String, Detached> DETACHED = new HashMap<>();

    private record Detached(SourceRuntime source, Timer timer) {}

    /** @throws ConnectException naming the option if the folder or the address cannot be used */
    static SourceRuntime open(NgsiSourceConfig config, TaskJournals.Committed committed) {
        Ledger ledger = new Ledger();
        TaskJournals journals = openJournals(config, committed, ledger);
        try {
            String journal = journals.own().id();
            ledger.detail("journal", () -> JsonNodeFactory.instance.textNode(journal));
            ledger.detail("orphans", () -> orphans(journals));
            SubscriptionManager subscriptions = new SubscriptionManager(config, ledger);
            JournalRecordLog recordLog = new JournalRecordLog(journals.own(), ledger);
            NotificationEndpoint endpoint = NotificationEndpoint.open(
                    config, subscriptions.tracked(recordLog), ledger, subscriptions::arrived, BIND_TIMEOUT);
            LedgerBean bean = LedgerBean.show(ledger, "ngsi-source", config.name(), config.taskIndex());
            SourceRuntime source = new SourceRuntime(config, journals, subscriptions, endpoint, ledger, bean);
            source.subscribe(recordLog);
            return source;
        } catch (RuntimeException | Error e) {
            journals.close();
            throw e;
        }
    }

    private void subscribe(JournalRecordLog recordLog) {
        try {
            subscriptions.start(endpoint.port(), recordLog);
        } catch (RuntimeException | Error e) {
            close();
            throw e;
        }
    }

    private static TaskJournals openJournals(NgsiSourceConfig config, TaskJournals.Committed committed, Ledger ledger) {
        JournalFolders folders = new JournalFolders(config.journal().dir(), config.name(), config.journalSettings());
        try {
            return new TaskJournals(folders, config.taskIndex(), committed, config.safety(), ledger);
        } catch (UncheckedIOException e) {
            String cause = e.getMessage() + " (" + e.getCause() + ")";
            throw new ConnectException(cause + "; change " + JournalOptions.DIR + " or make the folder writable", e);
        }
    }

    private static JsonNode orphans(TaskJournals journals) {
        ArrayNode orphans = JsonNodeFactory.instance.arrayNode();
        journals.orphans()
                .forEach(orphan -> orphans.addObject()
                        .put("connector", orphan.owner())
                        .put("folder", orphan.folder().toString())
                        .put("bytes", orphan.bytes()));
        return orphans;
    }

    /** Continues without a task; closes, and leaves its journal on disk, if no task claims it within the stand-by time. */
    void detach() {
        String name = name(config);
        Duration timeout = config.journal().standby();
        Detached detached = new Detached(this, new Timer("ngsi-source-standby", true));
        subscriptions.rest(true);
        synchronized (DETACHED) {
            DETACHED.put(name, detached);
        }
        LOG.warn(
                "Kafka is unavailable and the worker stopped the task of {}; the source accepts notifications for {} s"
                        + " more",
                name,
                timeout.toSeconds());
        TimerTask expiry = new TimerTask() {
            @Override
            public void run() {
                expire(name, detached);
            }
        };
        detached.timer.schedule(expiry, timeout.toMillis());
    }

    private static void expire(String name, Detached detached) {
        synchronized (DETACHED) {
            if (!DETACHED.remove(name, detached)) {
                return;
            }
        }
        LOG.warn("no task was started for {}; its journal waits for the next task", name);
        detached.timer.cancel();
        detached.source.close();
    }

    /** The source that runs without its task, if its options are unchanged; otherwise the source is closed. */
    static Optional<SourceRuntime> attach(NgsiSourceConfig config) {
        Detached detached;
        synchronized (DETACHED) {
            detached = DETACHED.remove(name(config));
        }
        if (detached == null) {
            return Optional.empty();
        }
        detached.timer.cancel();
        SourceRuntime source = detached.source;
        if (source.config.originalsStrings().equals(config.originalsStrings())) {
            source.subscriptions.rest(false);
            return Optional.of(source);
        }
        source.close();
        return Optional.empty();
    }

    private static String name(NgsiSourceConfig config) {
        return config.name() + " " + config.taskIndex();
    }

    /** Stops the listener and all requests to the context broker; the journals stay open. */
    void stopListening() {
        endpoint.close();
        subscriptions.close();
    }

    @Override
    public void close() {
        stopListening();
        bean.close();
        journals.close();
    }
}
