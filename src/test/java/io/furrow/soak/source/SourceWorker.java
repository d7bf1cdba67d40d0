package io.furrow.soak.source;

import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.embedded.FreePort;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;

/** A Connect worker that runs the NGSI source with one task; it can be killed and started again. */
final class SourceWorker extends WorkerProcess {
    static final String CONNECTOR = "ngsi-source";

    private static final Duration TIMEOUT = Duration.ofSeconds(120);

    private final Path folder;
    private final boolean exactlyOnce;
    private final int port = FreePort.orFree(0);

    /**
     * @param folder for log and journals
     * @param settings of the worker, {@code name=value}, in addition to the defaults
     */
    SourceWorker(Path folder, String bootstrapServers, boolean exactlyOnce, String... settings) {
        super(folder, bootstrapServers, Map.of(), settings(exactlyOnce, settings));
        this.folder = folder;
        this.exactlyOnce = exactlyOnce;
    }

    /** Settings of a worker for a delivery guarantee. */
    static List<String> settings(boolean exactlyOnce, String... others) {
        List<String> settings = new ArrayList<>(List.of("offset.flush.interval.ms=5000"));
        if (exactlyOnce) {
            settings.add("exactly.once.source.support=enabled");
        }
        settings.addAll(List.of(others));
        return settings;
    }

    /** The configuration that all sources here have in common. */
    static ObjectNode config(boolean exactlyOnce) {
        ObjectNode config = JsonNodeFactory.instance
                .objectNode()
                .put("connector.class", "io.furrow.connect.source.NgsiSourceConnector")
                .put("key.converter", "org.apache.kafka.connect.storage.StringConverter")
                .put("value.converter", "org.apache.kafka.connect.converters.ByteArrayConverter")
                .put("header.converter", "org.apache.kafka.connect.storage.StringConverter");
        if (exactlyOnce) {
            config.put("exactly.once.support", "required");
            // a worker that starts waits for open transactions of a killed one
            config.put("producer.override.transaction.timeout.ms", "10000");
        }
        return config;
    }

    /** Creates or changes the source once the worker accepts it; returns once the source accepts notifications. */
    void createSource() {
        createConnector(
                CONNECTOR,
                config(exactlyOnce)
                        .put("tasks.max", "1")
                        .put("listen.port", Integer.toString(port))
                        .put(
                                "journal.dir",
                                folder.resolve("journal").toAbsolutePath().toString()));
        awaitListening();
    }

    void awaitListening() {
        Until.isTrue("the source listens", TIMEOUT, () -> health().has("received"));
    }

    /** Returns once no accepted notification waits for Kafka. */
    void awaitDrained() {
        Until.isTrue(
                "the journal is drained",
                TIMEOUT,
                () -> health().path("pending").asLong(-1) == 0);
    }

    /** The health of the source; empty if it does not respond. */
    JsonNode health() {
        return Http.get(URI.create("http://127.0.0.1:" + port + "/health")).body();
    }

    int port() {
        return port;
    }
}
