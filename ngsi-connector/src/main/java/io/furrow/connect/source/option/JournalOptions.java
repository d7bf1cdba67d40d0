package io.furrow.connect.source.option;

import java.net.URI;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.OptionGroup;
import io.furrow.connect.journal.JournalFolders;

/** Options for the journal that stores accepted records until they are in Kafka. */
public record JournalOptions(AbstractConfig config) {
    public static final String DIR = "journal.dir";
    public static final String MAX_BYTES = "journal.max.bytes";
    static final String MIN_FREE_BYTES = "journal.min.free.bytes";
    static final String STANDBY = "journal.standby.ms";
    static final String RETENTION = "journal.retention.ms";

    private static final long MIB = 1024 * 1024;

    public static void define(ConfigDef options) {
        OptionGroup group = new OptionGroup(options, "Journal");
        group.high()
                .text(
                        DIR,
                        ConfigDef.NO_DEFAULT_VALUE,
                        LambdaValidator.with(JournalOptions::requireAbsolutePath, () -> "an absolute path"),
                        "Folder",
                        "Folder on each worker's own disk for accepted records that are not in Kafka yet; created if missing."
                                + " It must outlive the worker's process: in a container, a volume. All NGSI sources of a"
                                + " worker can share it.");
        group.number(
                MAX_BYTES,
                4096 * MIB,
                Range.atLeast(64 * MIB),
                "Size (bytes)",
                "Bytes on disk that each task's journal may take. It fills while Kafka is unavailable; when it is full,"
                        + " no more records are accepted. 1 GiB holds about 800,000 notifications of 1 kB.");
        group.low()
                .number(
                        MIN_FREE_BYTES,
                        256 * MIB,
                        Range.atLeast(0),
                        "Free (bytes)",
                        "Bytes that a journal leaves free on its disk; with less, no more records are accepted.");
        group.number(
                STANDBY,
                Duration.ofMinutes(10).toMillis(),
                Range.between(0, Duration.ofDays(1).toMillis()),
                "Stand-by (ms)",
                "Milliseconds that the source accepts notifications after a worker that does not reach Kafka has"
                        + " stopped the task, which it does after heartbeat.interval.ms. It starts the task again when"
                        + " Kafka is back. 0 stops listening with the task.");
        defineRetention(group);
    }

    private static void defineRetention(OptionGroup group) {
        group.number(
                RETENTION,
                Duration.ofMinutes(2).toMillis(),
                Range.between(0, Duration.ofDays(1).toMillis()),
                "Retention (ms)",
                "Milliseconds that records stay in the journal after Kafka has acknowledged them, unless it is half full. A"
                        + " broker that lost power, and has no replica, may come back without the last of them: at each"
                        + " start, and where the offsets of a partition step back, the source looks for them and sends again"
                        + " what is missing. That needs " + SizeOptions.ADMIN_PREFIX
                        + "bootstrap.servers, and no transforms.");
    }

    private static void requireAbsolutePath(String name, Object value) {
        try {
            if (value == null || !Path.of((String) value).isAbsolute()) {
                throw new ConfigException(name, value, "expected an absolute path");
            }
        } catch (InvalidPathException e) {
            throw new ConfigException(name, value, "no path: " + e.getMessage());
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
