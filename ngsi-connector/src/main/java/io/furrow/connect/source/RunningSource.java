package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.apache.kafka.connect.errors.ConnectException;

import io.furrow.connect.journal.JournalFolders;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.ledger.LedgerBean;

/** What takes notifications into a journal; it does not need Kafka, and can go from one task to the next. */
record RunningSource(
        Map<String, String> properties,
        TaskJournals journals,
        OwnSubscriptions subscriptions,
        Reception reception,
        Ledger ledger,
        LedgerBean bean)
        implements AutoCloseable {
    /** @throws ConnectException naming the option if the folder or the address cannot be used */
    static RunningSource open(NgsiSourceConfig config, TaskJournals.Committed committed) {
        Ledger ledger = new Ledger();
        TaskJournals journals = openJournals(config, committed, ledger);
        try {
            String journal = journals.own().id();
            ledger.detail("journal", () -> JsonNodeFactory.instance.textNode(journal));
            ledger.detail("orphans", () -> orphans(journals));
            OwnSubscriptions subscriptions = OwnSubscriptions.of(config, ledger);
            JournaledIntake intake = new JournaledIntake(journals.own(), ledger);
            Reception reception = Reception.open(config, subscriptions.watched(intake), ledger, subscriptions::arrived);
            LedgerBean bean = LedgerBean.show(ledger, config.name(), config.taskIndex());
            RunningSource source =
                    new RunningSource(config.originalsStrings(), journals, subscriptions, reception, ledger, bean);
            source.subscribe(intake);
            return source;
        } catch (RuntimeException | Error e) {
            journals.close();
            throw e;
        }
    }

    private void subscribe(JournaledIntake intake) {
        try {
            subscriptions.start(reception.port(), intake);
        } catch (RuntimeException | Error e) {
            close();
            throw e;
        }
    }

    private static TaskJournals openJournals(NgsiSourceConfig config, TaskJournals.Committed committed, Ledger ledger) {
        JournalFolders folders = new JournalFolders(config.journal().dir(), config.name(), config.journalSettings());
        try {
            return new TaskJournals(folders, config.taskIndex(), committed, ledger);
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

    /** Answers nothing more, and asks nothing of the context broker; the journals stay open. */
    void stopListening() {
        reception.close();
        subscriptions.close();
    }

    @Override
    public void close() {
        stopListening();
        bean.close();
        journals.close();
    }
}
