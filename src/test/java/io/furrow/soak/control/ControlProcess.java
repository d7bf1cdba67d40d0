package io.furrow.soak.control;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.embedded.FreePort;

/** Runs {@code furrow control-plane} as a process, on the same ports and directory after each start. */
public final class ControlProcess implements AutoCloseable {
    private final String name;
    private final Path log;
    private final URI api;
    private final URI health;
    private final JavaProcess process;

    /**
     * Settings of a control plane.
     *
     * @param heap maximum heap size, as in {@code 512m}
     * @param options of the command except those for Kafka, ports, state and log
     */
    public record Settings(String bootstrapServers, String heap, List<String> options) {}

    /** @param folder for state and log; processes with the same folder have different names */
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

    /** Kills the process like {@code kill -9}. */
    public void kill() throws InterruptedException {
        process.kill();
    }

    /** Stops the process. @return whether it stopped in time */
    public boolean stop() throws InterruptedException {
        return process.stop();
    }

    public boolean isAlive() {
        return process.isAlive();
    }

    public String name() {
        return name;
    }

    /** Base URL of the REST API. */
    public URI api() {
        return api;
    }

    public Path log() {
        return log;
    }

    /** The page {@code /ready}; a missing node without a response. */
    public JsonNode readiness() {
        return Http.get(health.resolve("/ready")).body();
    }

    /** Whether it, all of its parts and the servers that it uses are up. */
    public boolean isReady() {
        return readiness().path("status").asText().equals("ready");
    }

    @Override
    public void close() {
        process.close();
    }
}
