package io.furrow.connect.source;

import java.net.URI;
import java.nio.file.InvalidPathException;
import java.nio.file.Path;
import java.time.Duration;

import org.apache.kafka.common.config.AbstractConfig;
import org.apache.kafka.common.config.ConfigDef;
import org.apache.kafka.common.config.ConfigDef.Importance;
import org.apache.kafka.common.config.ConfigDef.LambdaValidator;
import org.apache.kafka.common.config.ConfigDef.Range;
import org.apache.kafka.common.config.ConfigDef.Type;
import org.apache.kafka.common.config.ConfigDef.Width;
import org.apache.kafka.common.config.ConfigException;

import io.furrow.connect.journal.JournalFolders;

/** Where what was taken is kept until Kafka has it. */
record JournalOptions(AbstractConfig config) {
    static final String DIR = "journal.dir";
    static final String MAX_BYTES = "journal.max.bytes";
    static final String MIN_FREE_BYTES = "journal.min.free.bytes";
    static final String STANDBY = "journal.standby.ms";

    private static final long MIB = 1024 * 1024;

    static void define(ConfigDef options) {
        String group = "Journal";
        options.define(
                DIR,
                Type.STRING,
                ConfigDef.NO_DEFAULT_VALUE,
                LambdaValidator.with(JournalOptions::requireAbsolutePath, () -> "an absolute path"),
                Importance.HIGH,
                "Folder on each worker's own disk for what was taken and is not in Kafka yet; made if it does not exist. It"
                        + " must outlive the worker's process: in a container, a volume. All NGSI sources of a worker can"
                        + " share it.",
                group,
                1,
                Width.LONG,
                "Folder");
        options.define(
                MAX_BYTES,
                Type.LONG,
                4096 * MIB,
                Range.atLeast(64 * MIB),
                Importance.MEDIUM,
                "Bytes on disk that each task's journal may take. While Kafka is away it fills; when it is full, nothing more"
                        + " is taken. 1 GiB holds about 800,000 notifications of 1 kB.",
                group,
                2,
                Width.MEDIUM,
                "Size (bytes)");
        options.define(
                MIN_FREE_BYTES,
                Type.LONG,
                256 * MIB,
                Range.atLeast(0),
                Importance.LOW,
                "Bytes that a journal leaves free on its disk; with less, nothing more is taken.",
                group,
                3,
                Width.MEDIUM,
                "Free (bytes)");
        options.define(
                STANDBY,
                Type.LONG,
                Duration.ofMinutes(10).toMillis(),
                Range.between(0, Duration.ofDays(1).toMillis()),
                Importance.MEDIUM,
                "Milliseconds that notifications are still taken when a worker that does not find Kafka has stopped the task,"
                        + " which it does after heartbeat.interval.ms. It starts the task again when Kafka is back. 0 stops"
                        + " listening with the task.",
                group,
                4,
                Width.MEDIUM,
                "Stand-by (ms)");
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

    Path dir() {
        return Path.of(config.getString(DIR));
    }

    /**
     * Where the repair keeps what outlives a restart: beside the journals of a connector, not among them. Each context broker
     * has its own, or every entity of the former would be told as deleted when the connector is pointed to another.
     */
    Path repairFolder(String connector, URI contextBroker) {
        return dir().resolve(JournalFolders.folderName(connector) + ".repair")
                .resolve(JournalFolders.folderName(contextBroker.toString()));
    }

    long maxBytes() {
        return config.getLong(MAX_BYTES);
    }

    Duration standby() {
        return Duration.ofMillis(config.getLong(STANDBY));
    }

    long minFreeBytes() {
        return config.getLong(MIN_FREE_BYTES);
    }
}
