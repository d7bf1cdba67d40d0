package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.source.SourceRecord;
import org.apache.kafka.connect.source.SourceTask;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.PluginVersion;
import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.journal.JournalSettings;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.ledger.LedgerBean;

/** Listens for notifications, answers when they are in its journal, and hands the journal's records to the worker. */
public class NgsiSourceTask extends SourceTask {
    private static final Logger LOG = LoggerFactory.getLogger(NgsiSourceTask.class);

    private static final Duration POLL_WAIT = Duration.ofMillis(200);

    private final AtomicReference<Reception> reception = new AtomicReference<>();
    private final AtomicReference<JournalKeeper> keeper = new AtomicReference<>();
    private final AtomicReference<TaskJournals> journals = new AtomicReference<>();
    private final AtomicReference<LedgerBean> bean = new AtomicReference<>();
    private final AtomicReference<OwnSubscriptions> subscriptions = new AtomicReference<>();
    private Ledger ledger;
    private int batchSize;

    /** Made by the worker. */
    public NgsiSourceTask() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public void start(Map<String, String> properties) {
        NgsiSourceConfig config = new NgsiSourceConfig(properties);
        ledger = new Ledger();
        batchSize = config.acknowledging().batchSize();
        try {
            journals.set(open(config));
            String journal = journals.get().own().id();
            ledger.detail("journal", () -> JsonNodeFactory.instance.textNode(journal));
            ledger.detail("orphans", this::orphans);
            subscriptions.set(OwnSubscriptions.of(config, ledger));
            Intake intake = new JournaledIntake(journals.get().own(), ledger);
            reception.set(
                    Reception.open(config, subscriptions.get().watched(intake), ledger, subscriptions.get()::arrived));
            keeper.set(JournalKeeper.start(journals.get(), config.taskCount() > 1));
            subscriptions.get().start(port(), intake);
            bean.set(LedgerBean.show(ledger, config.name(), config.taskIndex()));
        } catch (RuntimeException e) {
            // The worker does not stop a task that did not start.
            stop();
            throw e;
        }
        LOG.info(
                "{} takes notifications on {}:{} into {}",
                config.name(),
                config.listening().host(),
                port(),
                journals.get().own().folder());
    }

    private TaskJournals open(NgsiSourceConfig config) {
        JournalSettings settings = JournalSettings.of(
                config.journal().maxBytes(),
                config.pending().maxBytes(),
                config.journal().minFreeBytes());
        JournalFolders folders = new JournalFolders(config.journal().dir(), config.name(), settings);
        try {
            return new TaskJournals(
                    folders,
                    config.taskIndex(),
                    journal -> SourceOffsets.committed(context.offsetStorageReader(), journal),
                    ledger);
        } catch (UncheckedIOException e) {
            String cause = e.getMessage() + " (" + e.getCause() + ")";
            throw new ConnectException(cause + "; change " + JournalOptions.DIR + " or make the folder writable", e);
        }
    }

    /** The port that is listened on. */
    int port() {
        return reception.get().port();
    }

    private JsonNode orphans() {
        ArrayNode orphans = JsonNodeFactory.instance.arrayNode();
        TaskJournals open = journals.get();
        if (open != null) {
            open.orphans()
                    .forEach(orphan -> orphans.addObject()
                            .put("connector", orphan.owner())
                            .put("folder", orphan.folder().toString())
                            .put("bytes", orphan.bytes()));
        }
        return orphans;
    }

    @Override
    public List<SourceRecord> poll() throws InterruptedException {
        TaskJournals open = journals.get();
        open.own().failure().ifPresent(failure -> {
            throw new ConnectException(
                    "the disk of " + open.own().folder() + " failed again and again; look at it or change "
                            + JournalOptions.DIR + ", then restart the task",
                    failure);
        });
        TaskJournals.Turn turn = open.next(batchSize, POLL_WAIT);
        if (turn.records().isEmpty()) {
            return null;
        }
        List<SourceRecord> records = SourceRecords.of(turn);
        subscriptions.get().handedOn(records);
        return records;
    }

    /** Without metadata the record was filtered out or skipped by the worker's own settings. */
    @Override
    public void commitRecord(SourceRecord record, RecordMetadata metadata) {
        TaskJournals open = journals.get();
        if (open == null) {
            return;
        }
        if (metadata == null) {
            open.skipped(
                    SourceOffsets.journalOf(record.sourcePartition()), SourceOffsets.sequenceOf(record.sourceOffset()));
        } else {
            open.produced();
        }
    }

    /** Once the worker calls this it commits nothing more, so the journals may go to another task. */
    @Override
    public void stop() {
        OwnSubscriptions own = subscriptions.get();
        if (own != null) {
            own.close();
        }
        Reception listening = reception.getAndSet(null);
        if (listening != null) {
            listening.close();
        }
        LedgerBean shown = bean.getAndSet(null);
        if (shown != null) {
            shown.close();
        }
        JournalKeeper keeping = keeper.getAndSet(null);
        if (keeping != null) {
            keeping.close();
        }
        TaskJournals open = journals.getAndSet(null);
        if (open != null) {
            open.close();
        }
    }
}
