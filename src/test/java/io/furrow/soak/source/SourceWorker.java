package io.furrow.soak.source;

import java.io.IOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.embedded.FreePort;
import io.furrow.model.ngsi.NgsiJson;

/** A Connect worker in a process of its own that runs the NGSI source; it can be killed and started again. */
final class SourceWorker implements AutoCloseable {
    private static final Duration PATIENCE = Duration.ofSeconds(120);

    private final Path folder;
    private final String bootstrapServers;
    private final boolean exactlyOnce;
    private final List<String> settings;
    private final int restPort = FreePort.orFree(0);
    private final int port = FreePort.orFree(0);
    private final HttpClient client =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private Process process;

    /**
     * @param folder for its log and the journals
     * @param settings of the worker, {@code name=value}, other than Connect's own
     */
    SourceWorker(Path folder, String bootstrapServers, boolean exactlyOnce, String... settings) {
        this.settings = List.of(settings);
        this.folder = folder;
        this.bootstrapServers = bootstrapServers;
        this.exactlyOnce = exactlyOnce;
    }

    /** Starts the process; it finds the connector if that was created before. */
    void start() throws IOException {
        List<String> command = new ArrayList<>(List.of(
                Path.of(System.getProperty("java.home"), "bin", "java").toString(),
                "-Xmx384m",
                "-cp",
                System.getProperty("java.class.path"),
                WorkerMain.class.getName(),
                bootstrapServers,
                System.getProperty("furrow.plugins"),
                Integer.toString(restPort),
                "offset.flush.interval.ms=5000"));
        if (exactlyOnce) {
            command.add("exactly.once.source.support=enabled");
        }
        command.addAll(settings);
        process = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.appendTo(
                        Files.createDirectories(folder).resolve("worker.log").toFile()))
                .start();
    }

    /** Creates or changes the source as soon as the worker takes it; returns when it takes notifications. */
    void createSource() {
        ObjectNode config = JsonNodeFactory.instance
                .objectNode()
                .put("connector.class", "io.furrow.connect.source.NgsiSourceConnector")
                .put("tasks.max", "1")
                .put("key.converter", "org.apache.kafka.connect.storage.StringConverter")
                .put("value.converter", "org.apache.kafka.connect.converters.ByteArrayConverter")
                .put("header.converter", "org.apache.kafka.connect.storage.StringConverter")
                .put("listen.port", Integer.toString(port))
                .put("journal.dir", folder.resolve("journal").toAbsolutePath().toString());
        if (exactlyOnce) {
            config.put("exactly.once.support", "required");
            // A worker that starts waits for transactions that a killed one left open.
            config.put("producer.override.transaction.timeout.ms", "10000");
        }
        URI target = URI.create("http://127.0.0.1:" + restPort + "/connectors/ngsi-source/config");
        HttpRequest request = HttpRequest.newBuilder(target)
                .header("Content-Type", "application/json")
                .PUT(HttpRequest.BodyPublishers.ofString(config.toString()))
                .build();
        Waiting.until("the worker takes the connector", PATIENCE, () -> send(request) / 100 == 2);
        awaitListening();
    }

    void awaitListening() {
        Waiting.until("the source listens", PATIENCE, () -> health().has("received"));
    }

    /** Returns when nothing that was taken waits for Kafka any more. */
    void awaitDrained() {
        Waiting.until(
                "the journal is drained",
                PATIENCE,
                () -> health().path("pending").asLong(-1) == 0);
    }

    /** What the source says of itself; empty while it does not answer. */
    JsonNode health() {
        try {
            HttpRequest request = HttpRequest.newBuilder(URI.create("http://127.0.0.1:" + port + "/health"))
                    .timeout(Duration.ofSeconds(5))
                    .build();
            return NgsiJson.mapper()
                    .readTree(client.send(request, HttpResponse.BodyHandlers.ofByteArray())
                            .body());
        } catch (IOException e) {
            return NgsiJson.mapper().createObjectNode();
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    private int send(HttpRequest request) {
        try {
            return client.send(request, HttpResponse.BodyHandlers.discarding()).statusCode();
        } catch (IOException e) {
            return 0;
        } catch (InterruptedException e) {
            throw new IllegalStateException(e);
        }
    }

    int port() {
        return port;
    }

    /** Resident memory in MiB, from Linux' proc; 0 elsewhere. */
    long residentMib() throws IOException {
        return statusMib("VmRSS:");
    }

    /** The most that was resident at any time, in MiB, from Linux' proc; 0 elsewhere. */
    long peakResidentMib() throws IOException {
        return statusMib("VmHWM:");
    }

    private long statusMib(String name) throws IOException {
        Path status = Path.of("/proc/" + process.pid() + "/status");
        if (Files.notExists(status)) {
            return 0;
        }
        return Files.readAllLines(status).stream()
                .filter(line -> line.startsWith(name))
                .mapToLong(line -> Long.parseLong(line.replaceAll("\\D", "")) / 1024)
                .findFirst()
                .orElse(0);
    }

    /** Ends it as {@code kill -9} does. */
    void kill() throws InterruptedException {
        process.destroyForcibly();
        process.waitFor();
    }

    @Override
    public void close() {
        try {
            process.destroy();
            if (!process.waitFor(20, TimeUnit.SECONDS)) {
                process.destroyForcibly();
            }
        } catch (InterruptedException e) {
            process.destroyForcibly();
            Thread.currentThread().interrupt();
        }
    }
}
