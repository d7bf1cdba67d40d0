package io.furrow.connect.sink;

import java.util.ArrayList;
import java.util.Collection;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.Set;

import org.apache.kafka.common.TopicPartition;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.errors.DataException;
import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.sink.ErrantRecordReporter;
import org.apache.kafka.connect.sink.SinkRecord;
import org.apache.kafka.connect.sink.SinkTask;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.PluginVersion;
import io.furrow.connect.broker.BrokerBackoff;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.ledger.LedgerBean;
import io.furrow.connect.sink.api.BrokerUnavailableException;
import io.furrow.connect.sink.api.ContextWriter;
import io.furrow.connect.sink.api.ContextWriter.ChangeResults;
import io.furrow.connect.sink.api.ContextWriter.RejectedChange;
import io.furrow.connect.sink.api.EntityChange;
import io.furrow.connect.sink.api.WrongSettingException;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Writes each delivery of the worker before it accepts the next, so that committed records are written. Unreadable and
 * rejected records go to the errant-record reporter after all others are written. If the context broker is unavailable,
 * the same records are retried.
 */
public class NgsiSinkTask extends SinkTask {
    private record Errant(SinkRecord record, Exception cause) {}

    private static final Logger LOG = LoggerFactory.getLogger(NgsiSinkTask.class);

    private final SinkLedger ledger = new SinkLedger();
    private final Set<String> keylessTopics = new HashSet<>();
    private SinkEntityOptions entities;
    private ChangeReader reader;
    private ContextWriter writer;
    private BrokerBackoff backoff;
    private boolean hasNeighbors;
    private LedgerBean bean;

    /** Called by the worker. */
    public NgsiSinkTask() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public void start(Map<String, String> properties) {
        NgsiSinkConfig config = new NgsiSinkConfig(properties);
        entities = config.entities();
        reader = new ChangeReader(entities.scope(), entities.defaultType());
        hasNeighbors = config.hasSeveralTasks();
        writer = config.writer();
        backoff = config.delivery().backoff();
        bean = LedgerBean.show(ledger, "ngsi-sink", config.name(), config.taskIndex());
    }

    /** Other tasks may have written the cached entities. */
    @Override
    public void open(Collection<TopicPartition> partitions) {
        writer.forget();
    }

    @Override
    public void put(Collection<SinkRecord> delivered) {
        List<SinkRecord> records = List.copyOf(delivered);
        if (records.isEmpty()) {
            return;
        }
        List<Errant> errant = new ArrayList<>();
        List<EntityChange> changes = new ArrayList<>(records.size());
        int echo = 0;
        int ignored = 0;
        for (int i = 0; i < records.size(); i++) {
            SinkRecord record = records.get(i);
            if (entities.isEcho(RecordHeaders.text(record, HeaderNames.CE_SOURCE, ""))) {
                echo++;
            } else if (record.value() == null && !entities.deletesOnNull()) {
                ignored++;
            } else {
                read(record, i, changes, errant);
            }
        }
        int unreadable = errant.size();
        ChangeResults changeResults = write(changes);
        for (RejectedChange refused : changeResults.refused) {
            String message = "the context broker rejects the entity: " + refused.words();
            errant.add(new Errant(records.get(refused.entityChange().source()), new DataException(message)));
        }
        count(changeResults);
        ledger.received.add(records.size());
        ledger.echo.add(echo);
        ledger.ignored.add(ignored);
        ledger.unreadable.add(unreadable);
        report(errant);
    }

    private void read(SinkRecord record, int source, List<EntityChange> changes, List<Errant> errant) {
        if (record.key() == null && hasNeighbors && keylessTopics.add(record.topic())) {
            LOG.warn(
                    "Topic {} has records without key, so that several tasks may receive one entity: an older value can"
                            + " then overwrite a newer one for as long as {} allows; use the entity's id as the key, or"
                            + " set tasks.max=1",
                    record.topic(),
                    DeliveryOptions.MAX_KNOWN_AGE);
        }
        try {
            changes.add(reader.read(record, source));
        } catch (UnreadableException e) {
            errant.add(new Errant(record, e));
        }
    }

    private void count(ChangeResults changeResults) {
        ledger.written.add(changeResults.written);
        ledger.coalesced.add(changeResults.coalesced);
        ledger.stale.add(changeResults.stale);
        ledger.deleted.add(changeResults.deleted);
        ledger.refused.add(changeResults.refused.size());
    }

    private ChangeResults write(List<EntityChange> changes) {
        try {
            ChangeResults changeResults = writer.apply(changes);
            backoff.reset();
            return changeResults;
        } catch (BrokerUnavailableException e) {
            ledger.retried.increment();
            context.timeout(backoff.after(e.away().retryAfter()).toMillis());
            throw new RetriableException(e.getMessage(), e);
        } catch (WrongSettingException e) {
            ledger.retried.increment();
            context.timeout(backoff.after(Optional.empty()).toMillis());
            String remedy = "; tries again. Check " + BrokerOptions.URL + " and the rights of this client";
            throw new RetriableException(e.getMessage() + remedy, e);
        }
    }

    private void report(List<Errant> errant) {
        ErrantRecordReporter reporter = context.errantRecordReporter();
        for (Errant bad : errant) {
            if (reporter == null) {
                SinkRecord record = bad.record();
                String name = record.topic() + "-" + record.kafkaPartition() + "@" + record.kafkaOffset();
                String remedy = "; set errors.tolerance=all and errors.deadletterqueue.topic.name to skip such records";
                throw new ConnectException(name + ": " + bad.cause().getMessage() + remedy, bad.cause());
            }
            reporter.report(bad.record(), bad.cause());
        }
    }

    @Override
    public void stop() {
        if (writer != null) {
            writer.close();
        }
        if (bean != null) {
            bean.close();
        }
    }
}
