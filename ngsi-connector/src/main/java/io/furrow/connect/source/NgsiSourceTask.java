package io.furrow.connect.source;

import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.OptionalLong;
import java.util.concurrent.atomic.AtomicReference;

import org.apache.kafka.clients.producer.RecordMetadata;
import org.apache.kafka.connect.errors.ConnectException;
import org.apache.kafka.connect.source.SourceRecord;
import org.apache.kafka.connect.source.SourceTask;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.connect.PluginVersion;

/** Listens for notifications, answers when they are in its journal, and hands the journal's records to the worker. */
public class NgsiSourceTask extends SourceTask {
    private static final Logger LOG = LoggerFactory.getLogger(NgsiSourceTask.class);

    private static final Duration POLL_WAIT = Duration.ofMillis(200);

    private final AtomicReference<RunningSource> source = new AtomicReference<>();
    private final AtomicReference<JournalKeeper> keeper = new AtomicReference<>();
    private NgsiSourceConfig config;
    private int batchSize;
    private SourceRecords sourceRecords;

    /** Made by the worker. */
    public NgsiSourceTask() {}

    @Override
    public String version() {
        return PluginVersion.get();
    }

    @Override
    public void start(Map<String, String> properties) {
        config = new NgsiSourceConfig(properties);
        batchSize = config.acknowledging().batchSize();
        sourceRecords = config.records().records();
        try {
            source.set(Standby.leave(config)
                    .map(running -> resumed(running, this::committed))
                    .orElseGet(() -> RunningSource.open(config, this::committed)));
            keeper.set(JournalKeeper.start(source.get().journals(), config.taskCount() > 1));
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
                source.get().journals().own().folder());
    }

    private static RunningSource resumed(RunningSource running, TaskJournals.Committed committed) {
        try {
            running.journals().resume(committed);
            return running;
        } catch (RuntimeException e) {
            running.close();
            throw e;
        }
    }

    private OptionalLong committed(String journal) {
        return SourceOffsets.committed(context.offsetStorageReader(), journal);
    }

    /** The port that is listened on. */
    int port() {
        return source.get().reception().port();
    }

    @Override
    public List<SourceRecord> poll() throws InterruptedException {
        TaskJournals open = source.get().journals();
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
        List<SourceRecord> records = sourceRecords.of(turn);
        source.get().subscriptions().handedOn(records);
        return records;
    }

    /** Without metadata the record was filtered out or skipped by the worker's own settings. */
    @Override
    public void commitRecord(SourceRecord record, RecordMetadata metadata) {
        RunningSource running = source.get();
        if (running == null) {
            return;
        }
        if (metadata == null) {
            running.journals()
                    .skipped(
                            SourceOffsets.journalOf(record.sourcePartition()),
                            SourceOffsets.sequenceOf(record.sourceOffset()));
        } else {
            running.journals().produced();
        }
    }

    /**
     * Once the worker calls this it commits nothing more, so the journals may go to another task. While Kafka is away they and
     * the listener stay as they are: the worker will start the task again.
     */
    @Override
    public void stop() {
        JournalKeeper keeping = keeper.getAndSet(null);
        boolean away = keeping != null && keeping.close();
        RunningSource running = source.getAndSet(null);
        if (running == null) {
            return;
        }
        if (away && !config.journal().standby().isZero()) {
            Standby.enter(config, running);
        } else {
            running.close();
        }
    }
}
