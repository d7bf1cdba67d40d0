package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.source.SourceRecord;
import org.apache.kafka.connect.source.SourceTask;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.PluginVersion;
import io.furrow.connect.source.journal.JournalMaintenance;
import io.furrow.connect.source.journal.TaskJournals;
import io.furrow.connect.source.option.JournalOptions;
import io.furrow.connect.source.option.TopicOptions;

/**
 * Listens for notifications, answers each when its records are in the journal, and returns the journal's records to the
 * worker.
 */
public class NgsiSourceTask extends SourceTask {
    private static final Logger LOG = LoggerFactory.getLogger(NgsiSourceTask.class);

    private static final Duration POLL_WAIT = Duration.ofMillis(200);

    private final AtomicReference<SourceRuntime> source = new AtomicReference<>();
    private final AtomicReference<JournalMaintenance> maintenance = new AtomicReference<>();
    /** The offset of the newest record, by partition. */
    private final Map<String, Long> offsets = new ConcurrentHashMap<>();

    private volatile boolean hasLost;
    private NgsiSourceConfig config;
    private int batchSize;
    private SourceRecords sourceRecords;
    private TopicLimits limits;
    private RecordSizes sizes;

    /** Called by the worker. */
    public NgsiSourceTask() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public void start(Map<String, String> properties) {
        config = new NgsiSourceConfig(properties);
        batchSize = config.journal().batchSize();
        sourceRecords = config.records();
        try {
            source.set(SourceRuntime.attach(config)
                    .map(running -> resumed(running, this::committed))
                    .orElseGet(() -> SourceRuntime.open(config, this::committed)));
            askForLimits();
            maintenance.set(JournalMaintenance.start(source.get().journals(), config.taskCount() > 1));
        } catch (RuntimeException | Error e) {
            // The worker does not stop a task that failed to start.
            stop();
            throw e;
        }
        LOG.info(
                "{} accepts notifications on {}:{} for topic {}",
                config.name(),
                config.listening().host(),
                port(),
                source.get().journals().own().folder());
    }

    private static SourceRuntime resumed(SourceRuntime running, TaskJournals.Committed committed) {
        try {
            running.journals().resume(committed);
            return running;
        } catch (RuntimeException | Error e) {
            running.close();
            throw e;
        }
    }

    private void askForLimits() {
        TopicOptions topics = config.topics();
        limits = TopicLimits.open(
                config.sizes().admin(),
                "furrow-" + config.name() + "-" + config.taskIndex(),
                List.of(topics.topic(), topics.deadLetterTopic()));
        sizes = new RecordSizes(
                limits,
                config.sizes().maxRecordBytes(),
                topics.deadLetterTopic(),
                source.get().ledger());
    }

    private OptionalLong committed(String journal) {
        return SourceOffsets.committed(context.offsetStorageReader(), journal);
    }

    /** The port of the listener. */
    int port() {
        return source.get().endpoint().port();
    }

    @Override
    public List<SourceRecord> poll() throws InterruptedException {
        TaskJournals open = source.get().journals();
        open.own().failure().ifPresent(failure -> {
            throw new ConnectException(
                    "the disk of " + open.own().folder() + " failed repeatedly; check it or change "
                            + JournalOptions.DIR + ", then restart the task",
                    failure);
        });
        if (hasLost) {
            hasLost = false;
            open.resume(this::committed);
        }
        TaskJournals.Batch turn = open.next(batchSize, POLL_WAIT);
        if (turn.records().isEmpty()) {
            return null;
        }
        limits.refresh();
        List<SourceRecord> records = sourceRecords.of(turn, sizes::fitting);
        source.get().subscriptions().handedOn(records);
        return records;
    }

    /** Without metadata the record was filtered out or skipped because of the worker's settings. */
    @Override
    public void commitRecord(SourceRecord record, RecordMetadata metadata) {
        SourceRuntime running = source.get();
        if (running == null) {
            return;
        }
        String journal = SourceOffsets.journalOf(record.sourcePartition());
        long sequence = SourceOffsets.sequenceOf(record.sourceOffset());
        if (metadata == null) {
            running.journals().skipped(journal, sequence);
        } else {
            running.journals().produced(journal, sequence);
            watch(metadata);
        }
    }

    /** A broker that has lost records assigns their offsets again. */
    private void watch(RecordMetadata metadata) {
        if (metadata.hasOffset()) {
            Long before = offsets.put(metadata.topic() + "-" + metadata.partition(), metadata.offset());
            if (before != null && metadata.offset() <= before) {
                hasLost = true;
            }
        }
    }

    /**
     * After this call the worker neither polls nor commits, so the remaining records of the journals wait for another
     * task. The listener stops here to leave few records. While Kafka is unavailable, the listener and the journals
     * stay open: the worker will restart the task.
     */
    @Override
    public void stop() {
        if (limits != null) {
            limits.close();
        }
        JournalMaintenance stopping = maintenance.getAndSet(null);
        SourceRuntime running = source.getAndSet(null);
        boolean standby = stopping != null
                && stopping.isKafkaUnavailable()
                && !config.journal().standby().isZero();
        if (running != null && !standby) {
            running.stopListening();
        }
        if (stopping != null) {
            stopping.close();
        }
        if (running != null && standby) {
            running.detach();
        } else if (running != null) {
            running.close();
        }
    }
}
