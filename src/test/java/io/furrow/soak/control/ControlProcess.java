package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.embedded.FreePort;

/** {@code furrow control-plane} in a process of its own, on the same ports and directory whenever it is started. */
public final class ControlProcess implements AutoCloseable {
    private final String name;
    private final Path log;
    private final URI api;
    private final URI health;
    private final JavaProcess process;

    /**
     * What a control plane runs with.
     *
     * @param heap maximum heap size, as in {@code 512m}
     * @param options of the command beside those of Kafka, ports, state and log
     */
    public record Settings(String bootstrapServers, String heap, List<String> options) {}

    /** @param folder for its state and log; processes of one folder differ in their names */
    public ControlProcess(Path folder, String name, Settings settings) throws IOException {
        this.name = name;
        this.log = folder.resolve(name + ".log");
        int apiPort = FreePort.orFree(0);
        int healthPort = FreePort.orFree(0);
        this.api = URI.create("http://127.0.0.1:" + apiPort);
        this.health = URI.create("http://127.0.0.1:" + healthPort);
        Path client = Files.createDirectories(folder).resolve(name + ".properties");
        Files.writeString(client, "state.dir=" + folder.resolve(name + "-state").toAbsolutePath() + "\n");
        List<String> arguments = new ArrayList<>(List.of("control-plane", "--kafka", settings.bootstrapServers()));
        arguments.addAll(List.of("--kafka-properties", client.toString()));
        arguments.addAll(List.of("--control-port", Integer.toString(apiPort)));
        arguments.addAll(List.of("--health-port", Integer.toString(healthPort)));
        arguments.addAll(List.of("--log", log.toString()));
        arguments.addAll(settings.options());
        this.process = new JavaProcess(
                folder.resolve(name + ".out"),
                List.of("-Xmx" + settings.heap(), "-XX:+ExitOnOutOfMemoryError"),
                "io.furrow.launcher.Furrow",
                arguments);
    }

    public void start() throws IOException {
        process.start();
    }

    /** Ends it as {@code kill -9} does. */
    public void kill() throws InterruptedException {
        process.kill();
    }

    /** Asks it to stop. @return whether it stopped in time */
    public boolean stop() throws InterruptedException {
        return process.stop();
    }

    public boolean isAlive() {
        return process.isAlive();
    }

    public String name() {
        return name;
    }

    /** Base of the REST API. */
    public URI api() {
        return api;
    }

    public Path log() {
        return log;
    }

    /** The page {@code /ready}; a missing node where there is no answer. */
    public JsonNode readiness() {
        return Http.get(health.resolve("/ready")).body();
    }

    /** Whether it is ready and all of its parts, and what it speaks with, are up. */
    public boolean isReady() {
        return readiness().path("status").asText().equals("ready");
    }

    @Override
    public void close() {
        process.close();
    }
}
