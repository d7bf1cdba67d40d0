package io.furrow.connect.source;

import java.io.UncheckedIOException;
import java.net.InetSocketAddress;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.connect.data.Schema;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.header.ConnectHeaders;
import org.apache.kafka.connect.source.SourceRecord;
import org.apache.kafka.connect.source.SourceTask;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.PluginVersion;
import io.furrow.connect.ledger.Ledger;
import io.furrow.connect.ledger.LedgerJson;
import io.furrow.connect.source.PendingNotifications.Pending;
import io.furrow.model.ngsi.NgsiJson;

/** Listens for notifications, hands their records to the worker and answers when Kafka has them. */
public class NgsiSourceTask extends SourceTask {
    private static final Logger LOG = LoggerFactory.getLogger(NgsiSourceTask.class);

    private static final String NOTIFICATION = "notification";
    private static final Duration POLL_WAIT = Duration.ofMillis(200);
    private static final Duration BIND_PATIENCE = Duration.ofSeconds(10);
    private static final Duration IDLE_BEYOND_ACK = Duration.ofSeconds(30);

    private final AtomicReference<NotificationServer> server = new AtomicReference<>();
    private volatile PendingNotifications pending;
    private Ledger ledger;
    private Map<String, String> partition;
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
        pending = new PendingNotifications(
                config.pending().maxCount(), config.pending().maxBytes());
        ledger.gauge("pending", "Records that wait for Kafka", pending::records);
        ledger.gauge("pendingBytes", "Bytes of the records that wait for Kafka", pending::bytes);
        partition = Map.of("connector", config.name());
        batchSize = config.acknowledging().batchSize();
        server.set(listen(config));
        LOG.info(
                "{} takes notifications on {}:{}",
                config.name(),
                config.listening().host(),
                port());
    }

    private NotificationServer listen(NgsiSourceConfig config) {
        NotificationTranslator translator = new NotificationTranslator(config.translation(), ledger);
        ByteBudget bodies = new ByteBudget(config.pending().maxBytes());
        NotificationHandler.Limits limits = new NotificationHandler.Limits(
                config.sizes().maxBodyBytes(), bodies, config.acknowledging().ackTimeout());
        NotificationHandler handler = new NotificationHandler(translator, pending, ledger, limits, this::health);
        InetSocketAddress address = new InetSocketAddress(
                config.listening().host(), config.listening().port());
        try {
            Duration idle = config.acknowledging().ackTimeout().plus(IDLE_BEYOND_ACK);
            return NotificationServer.start(address, handler, idle, BIND_PATIENCE);
        } catch (UncheckedIOException e) {
            String remedy = "; free the address or change " + ListeningOptions.HOST + " or " + ListeningOptions.PORT;
            throw new ConnectException(e.getCause().getMessage() + remedy, e);
        }
    }

    /** The port that is listened on. */
    int port() {
        return server.get().port();
    }

    private byte[] health() {
        return NgsiJson.write(LedgerJson.of(ledger));
    }

    @Override
    public List<SourceRecord> poll() throws InterruptedException {
        List<Pending> next = pending.next(batchSize, POLL_WAIT);
        return next.isEmpty() ? null : next.stream().map(this::toRecord).toList();
    }

    private SourceRecord toRecord(Pending next) {
        OutgoingRecord record = next.record();
        ConnectHeaders headers = new ConnectHeaders();
        record.headers().forEach(headers::addString);
        return new SourceRecord(
                partition,
                Map.of(NOTIFICATION, next.notification()),
                record.topic(),
                null,
                record.key() == null ? null : Schema.STRING_SCHEMA,
                record.key(),
                record.value() == null ? Schema.OPTIONAL_BYTES_SCHEMA : Schema.BYTES_SCHEMA,
                record.value(),
                record.time().toEpochMilli(),
                headers);
    }

    /** Without metadata the record was filtered out or skipped by the worker's own settings: that is the end of it, too. */
    @Override
    public void commitRecord(SourceRecord record, RecordMetadata metadata) {
        ledger.durable.increment();
        (metadata == null ? ledger.skipped : ledger.produced).increment();
        pending.acknowledge((Long) record.sourceOffset().get(NOTIFICATION));
    }

    @Override
    public void stop() {
        PendingNotifications open = pending;
        if (open != null) {
            open.close();
        }
        NotificationServer listening = server.getAndSet(null);
        if (listening != null) {
            listening.close();
        }
    }
}
