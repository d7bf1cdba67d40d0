package io.furrow.connect.sink;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;

import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.errors.DataException;
import org.apache.kafka.connect.errors.RetriableException;
import org.apache.kafka.connect.header.Header;
import org.apache.kafka.connect.sink.ErrantRecordReporter;
import org.apache.kafka.connect.sink.SinkRecord;
import org.apache.kafka.connect.sink.SinkTask;

import io.furrow.connect.PluginVersion;
import io.furrow.connect.broker.BrokerClient;
import io.furrow.connect.broker.BrokerOptions;
import io.furrow.connect.sink.EntityWriter.AwayException;
import io.furrow.connect.sink.EntityWriter.RefusedUpdate;
import io.furrow.connect.sink.EntityWriter.WrongSettingException;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.event.HeaderNames;
import io.furrow.model.ngsi.UnreadableException;

/**
 * Writes each delivery of the worker as one update per entity. A record that cannot be read or is refused goes to the
 * errant-record reporter, after all others are written; a context broker that is away gets the same records again.
 */
public class NgsiSinkTask extends SinkTask {
    private record Errant(SinkRecord record, Exception cause) {}

    private EntityWriter writer;
    private FiwareScope defaultScope;
    private Duration backoff;

    /** Made by the worker. */
    public NgsiSinkTask() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public void start(Map<String, String> properties) {
        NgsiSinkConfig config = new NgsiSinkConfig(properties);
        ContextBroker broker =
                new ContextBroker(new BrokerClient(config.broker().settings()));
        writer = new EntityWriter(broker, config.batches());
        defaultScope = config.scope();
        backoff = config.retryBackoff();
    }

    @Override
    public void put(Collection<SinkRecord> delivered) {
        List<SinkRecord> records = List.copyOf(delivered);
        List<Errant> errant = new ArrayList<>();
        EntityUpdates updates = read(records, errant);
        for (RefusedUpdate refused : write(updates)) {
            String message = "the context broker refuses the entity: " + refused.words();
            for (int source : refused.update().sources()) {
                errant.add(new Errant(records.get(source), new DataException(message)));
            }
        }
        report(errant);
    }

    private EntityUpdates read(List<SinkRecord> records, List<Errant> errant) {
        EntityUpdates updates = new EntityUpdates();
        for (int i = 0; i < records.size(); i++) {
            SinkRecord record = records.get(i);
            if (record.value() == null) {
                continue;
            }
            try {
                long time = record.timestamp() == null ? Long.MIN_VALUE : record.timestamp();
                updates.add(scopeOf(record), ChangeReader.entity(record.value()), time, i);
            } catch (UnreadableException e) {
                errant.add(new Errant(record, e));
            }
        }
        return updates;
    }

    private FiwareScope scopeOf(SinkRecord record) throws UnreadableException {
        return ChangeReader.scope(
                header(record, HeaderNames.SERVICE, defaultScope.service()),
                header(record, HeaderNames.SERVICE_PATH, defaultScope.servicePath()));
    }

    private static String header(SinkRecord record, String name, String otherwise) {
        Header header = record.headers().lastWithName(name);
        return header == null || header.value() == null ? otherwise : String.valueOf(header.value());
    }

    private List<RefusedUpdate> write(EntityUpdates updates) {
        try {
            return writer.write(updates.merged());
        } catch (AwayException e) {
            context.timeout(backoff.toMillis());
            throw new RetriableException(e.getMessage(), e);
        } catch (WrongSettingException e) {
            String remedy = "; check " + BrokerOptions.URL + " and the rights of this client";
            throw new ConnectException(e.getMessage() + remedy, e);
        }
    }

    private void report(List<Errant> errant) {
        ErrantRecordReporter reporter = context.errantRecordReporter();
        for (Errant bad : errant) {
            if (reporter == null) {
                SinkRecord record = bad.record();
                String name = record.topic() + "-" + record.kafkaPartition() + "@" + record.kafkaOffset();
                String remedy = "; set errors.tolerance=all and errors.deadletterqueue.topic.name to set such aside";
                throw new ConnectException(name + ": " + bad.cause().getMessage() + remedy, bad.cause());
            }
            reporter.report(bad.record(), bad.cause());
        }
    }

    /** Nothing is kept between deliveries. */
    @Override
    public void stop() {}
}
