package io.furrow.connect.source.option;

import java.net.URI;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Validator;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.Validators;
import io.furrow.connect.journal.JournalFolders;

/**
 * Options for the journal that stores accepted records until they are in Kafka, for the records that wait in memory
 * before it, and for the number of records that a poll returns from it.
 */
public record JournalOptions(AbstractConfig config) {
    public static final String MAX_PENDING_BYTES = "max.pending.bytes";
    public static final String DIR = "journal.dir";
    public static final String MAX_BYTES = "journal.max.bytes";
    static final String MIN_FREE_BYTES = "journal.min.free.bytes";
    static final String STANDBY = "journal.standby.ms";
    static final String RETENTION = "journal.retention.ms";
    static final String BATCH_SIZE = "batch.size";

    private static final long MIB = 1024 * 1024;
    private static final Range UP_TO_A_DAY = Range.between(0, Duration.ofDays(1).toMillis());

    public static void define(ConfigDef options) {
        new OptionGroup(options, "Pending")
                .low()
                .number(MAX_PENDING_BYTES, 64 * MIB, Range.atLeast(1), "Pending (bytes)")
                .help(
                        "Bytes of records that may wait for the disk at a time; beyond it, further records wait. At least "
                                + SizeOptions.MAX_BODY_BYTES + ".");
        defineJournal(new OptionGroup(options, "Journal"));
        new OptionGroup(options, "Acknowledging")
                .low()
                .integer(BATCH_SIZE, 500, Range.between(1, 10_000), "Batch")
                .help("Maximum records returned to the worker per poll; a poll does not wait for more records than are"
                        + " available.");
    }

    private static void defineJournal(OptionGroup group) {
        Validator path = Validators.one(JournalOptions::requireAbsolute, "an absolute path");
        group.high()
                .text(DIR, ConfigDef.NO_DEFAULT_VALUE, path, "Folder")
                .help("Folder on each worker's own disk for accepted records that are not in Kafka yet; created if"
                        + " missing. It must outlive the worker's process: in a container, a volume. All NGSI sources"
                        + " of a worker can share it.");
        group.number(MAX_BYTES, 4096 * MIB, Range.atLeast(64 * MIB), "Size (bytes)")
                .help("Bytes on disk that each task's journal may take. It fills while Kafka is unavailable; when it is"
                        + " full, no more records are accepted. 1 GiB holds about 800,000 notifications of 1 kB.");
        group.low()
                .number(MIN_FREE_BYTES, 256 * MIB, Range.atLeast(0), "Free (bytes)")
                .help("Bytes that a journal leaves free on its disk; with less, no more records are accepted.");
        group.number(STANDBY, Duration.ofMinutes(10).toMillis(), UP_TO_A_DAY, "Stand-by (ms)")
                .help("Milliseconds that the source accepts notifications after a worker that does not reach Kafka has"
                        + " stopped the task, which it does after heartbeat.interval.ms. It starts the task again when"
                        + " Kafka is back. 0 stops listening with the task.");
        group.number(RETENTION, Duration.ofMinutes(2).toMillis(), UP_TO_A_DAY, "Retention (ms)")
                .help("Milliseconds that records stay in the journal after Kafka has acknowledged them, unless it is"
                        + " half full. A broker that lost power, and has no replica, may come back without the last of"
                        + " them: at each start, and where the offsets of a partition step back, the source looks for"
                        + " them and sends again what is missing. That needs " + SizeOptions.ADMIN_PREFIX
                        + "bootstrap.servers, and no transforms.");
    }

    private static void requireAbsolute(String path) {
        try {
            Validators.require(path != null && Path.of(path).isAbsolute(), "expected an absolute path");
        } catch (InvalidPathException e) {
            throw new IllegalArgumentException("no path: " + e.getMessage(), e);
        }
    }

    public Path dir() {
        return Path.of(config.getString(DIR));
    }

    /**
     * The folder in which the repair stores its state across restarts: beside the journals of a connector, not among
     * them. Each context broker has its own folder; otherwise every entity of the previous context broker would be
     * reported as deleted when the connector is pointed to another one.
     */
    public Path repairFolder(String connector, URI contextBroker) {
        return dir().resolve(JournalFolders.folderName(connector) + ".repair")
                .resolve(JournalFolders.folderName(contextBroker.toString()));
    }

    public long maxPendingBytes() {
        return config.getLong(MAX_PENDING_BYTES);
    }

    public int batchSize() {
        return config.getInt(BATCH_SIZE);
    }

    public long maxBytes() {
        return config.getLong(MAX_BYTES);
    }

    public Duration retention() {
        return Duration.ofMillis(config.getLong(RETENTION));
    }

    public Duration standby() {
        return Duration.ofMillis(config.getLong(STANDBY));
    }

    public long minFreeBytes() {
        return config.getLong(MIN_FREE_BYTES);
    }
}
