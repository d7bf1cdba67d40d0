package io.furrow.connect;

import java.io.IOException;
import java.io.InputStream;
import java.io.UncheckedIOException;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpRequest.BodyPublishers;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;
import java.util.zip.ZipEntry;
import java.util.zip.ZipInputStream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.clients.admin.NewTopic;

import io.furrow.embedded.EmbeddedConnect;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.FreePort;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.unchecked.Unchecked;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A real broker and a real worker that knows the connectors from the packaged plugin folder. */
public final class ConnectRig implements AutoCloseable {
    private final Path directory;
    private final HttpClient client =
            HttpClient.newBuilder().version(HttpClient.Version.HTTP_1_1).build();
    private final int kafkaPort = FreePort.orFree(0);
    private EmbeddedKafka kafka;
    private final EmbeddedConnect worker;

    private ConnectRig(Path directory, Map<String, String> workerSettings) {
        this.directory = directory;
        startKafka();
        worker = EmbeddedConnect.start(
                bootstrapServers(), unpackedPlugin(directory.resolve("plugins")), 0, workerSettings);
    }

    public static ConnectRig start(Path directory) {
        return start(directory, Map.of());
    }

    /** @param workerSettings come before those of the rig */
    public static ConnectRig start(Path directory, Map<String, String> workerSettings) {
        return new ConnectRig(directory, workerSettings);
    }

    public String bootstrapServers() {
        return "127.0.0.1:" + kafkaPort;
    }

    public void createTopic(NewTopic topic) {
        kafka.createTopics(List.of(topic));
    }

    /** Starts the broker, also after {@link #stopKafka()}: on the same port with the same log. */
    public void startKafka() {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"), kafkaPort);
    }

    public void stopKafka() {
        kafka.close();
    }

    /** A connector from its example in {@code config/} with other options; returns when its task runs. */
    public void create(String example, Map<String, String> options) {
        JsonNode shipped = json(read(Path.of("config", example + ".json")));
        create(shipped.path("name").textValue(), example, options);
    }

    /** A connector with another name than its example, or a change of it. */
    public void create(String name, String example, Map<String, String> options) {
        configure(name, example, options);
        awaitRunning(name);
    }

    /** As {@link #create}, for a connector that need not run now. */
    public void configure(String name, String example, Map<String, String> options) {
        JsonNode shipped = json(read(Path.of("config", example + ".json")));
        ObjectNode config = shipped.path("config").deepCopy();
        if (config.has("journal.dir")) {
            config.put("journal.dir", journals().toString());
        }
        if (config.has("admin.override.bootstrap.servers")) {
            config.put("admin.override.bootstrap.servers", bootstrapServers());
        }
        options.forEach(config::put);
        HttpResponse<String> created = ask("PUT", "/connectors/" + name + "/config", config.toString());
        assertThat(created.statusCode()).as(created.body()).isBetween(200, 201);
    }

    /** Where the journals of the connectors are. */
    public Path journals() {
        return directory.resolve("journal");
    }

    /** The worker's answer to any request, whatever its status; an empty body is none. */
    public HttpResponse<String> ask(String method, String path, String body) {
        return send(HttpRequest.newBuilder(worker.uri().resolve(path))
                .header("Content-Type", "application/json")
                .method(method, body.isEmpty() ? BodyPublishers.noBody() : BodyPublishers.ofString(body)));
    }

    /** Lets the tasks of a connector be, without an end of them; returns when its first task says so. */
    public void pause(String name) {
        assertThat(ask("PUT", "/connectors/" + name + "/pause", "").statusCode())
                .isEqualTo(202);
        awaitState(name, "PAUSED");
    }

    public void restart(String name) {
        HttpResponse<String> restarted =
                send(HttpRequest.newBuilder(worker.uri().resolve("/connectors/" + name + "/restart?includeTasks=true"))
                        .POST(BodyPublishers.noBody()));
        assertThat(restarted.statusCode()).as(restarted.body()).isEqualTo(202);
        awaitRunning(name);
    }

    /** Ends the tasks of a connector and keeps the rest of it; returns when they have ended. */
    public void stop(String name) {
        HttpResponse<String> stopped =
                send(HttpRequest.newBuilder(worker.uri().resolve("/connectors/" + name + "/stop"))
                        .PUT(BodyPublishers.noBody()));
        assertThat(stopped.statusCode()).as(stopped.body()).isEqualTo(204);
        await().until(() -> get("/connectors/" + name + "/status").path("tasks").isEmpty());
    }

    /** The opposite of {@link #stop}; returns when the first task runs. */
    public void resume(String name) {
        HttpResponse<String> resumed =
                send(HttpRequest.newBuilder(worker.uri().resolve("/connectors/" + name + "/resume"))
                        .PUT(BodyPublishers.noBody()));
        assertThat(resumed.statusCode()).as(resumed.body()).isEqualTo(202);
        awaitRunning(name);
    }

    /** The worker's REST API. */
    public URI rest() {
        return worker.uri();
    }

    /** The worker's answer to {@code PUT path}. */
    public JsonNode put(String path, JsonNode body) {
        return json(send(HttpRequest.newBuilder(worker.uri().resolve(path))
                        .header("Content-Type", "application/json")
                        .PUT(BodyPublishers.ofString(body.toString())))
                .body()
                .getBytes());
    }

    /** The worker's answer to {@code GET path}. */
    public JsonNode get(String path) {
        return json(
                send(HttpRequest.newBuilder(worker.uri().resolve(path))).body().getBytes());
    }

    /** Returns when the first task of the connector runs. */
    public void awaitRunning(String name) {
        awaitState(name, "RUNNING");
    }

    private void awaitState(String name, String state) {
        await().untilAsserted(() -> {
            JsonNode status = get("/connectors/" + name + "/status");
            assertThat(status.at("/tasks/0/state").asText())
                    .as(status.toString())
                    .isEqualTo(state);
        });
    }

    private HttpResponse<String> send(HttpRequest.Builder request) {
        return client.sendAsync(request.build(), HttpResponse.BodyHandlers.ofString())
                .join();
    }

    @Override
    public void close() {
        worker.close();
        kafka.close();
    }

    /** The zip that was built last: those of earlier versions may still be there. */
    static Path packagedPlugin() {
        try (Stream<Path> files = Files.list(Path.of("target"))) {
            return files.filter(file -> file.toString().endsWith(".zip"))
                    .max(Comparator.comparingLong(file -> file.toFile().lastModified()))
                    .orElseThrow();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static Path unpackedPlugin(Path into) {
        try (ZipInputStream zip = new ZipInputStream(Files.newInputStream(packagedPlugin()))) {
            for (ZipEntry entry = zip.getNextEntry(); entry != null; entry = zip.getNextEntry()) {
                Path file = into.resolve(entry.getName());
                if (entry.isDirectory()) {
                    Files.createDirectories(file);
                } else {
                    copy(zip, file);
                }
            }
            return into;
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    private static void copy(InputStream from, Path file) throws IOException {
        Files.createDirectories(file.getParent());
        Files.copy(from, file);
    }

    private static byte[] read(Path file) {
        return Unchecked.get(() -> Files.readAllBytes(file));
    }

    private static JsonNode json(byte[] bytes) {
        try {
            return NgsiJson.read(bytes);
        } catch (UnreadableException e) {
            throw new AssertionError(new String(bytes), e);
        }
    }
}
