package io.furrow.soak.devices;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.TimeUnit;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.embedded.FreePort;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.Until;

/** Runs {@code ./furrow up} as a process, on the same ports and directory after each start, and commands against it. */
public final class UpProcess implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(180);
    private static final long COMMAND_SECONDS = 90;
    private static final long STOP_SECONDS = 60;
    private static final List<String> PORTS =
            List.of("dashboard kafka connect flink notify mqtt orion iot-agent mongo control health".split(" "));

    private final List<String> furrow;
    private final Path folder;
    private final Map<String, Integer> ports = new LinkedHashMap<>();
    private final List<String> command = new ArrayList<>();
    private Process process;

    /** @param home checkout @param folder for data and output */
    public UpProcess(Path home, Path folder, List<String> options) throws IOException {
        this(List.of(home.resolve("furrow").toString()), folder, options);
    }

    /** @param furrow command that starts Furrow @param folder for data and output */
    public UpProcess(List<String> furrow, Path folder, List<String> options) throws IOException {
        this.furrow = furrow;
        this.folder = Files.createDirectories(folder);
        command.addAll(furrow);
        command.addAll(List.of("up", "--no-simulated-devices"));
        command.addAll(List.of("--data", folder.resolve("data").toString()));
        for (String port : PORTS) {
            ports.put(port, FreePort.orFree(0));
            command.addAll(List.of("--%s-port".formatted(port), ports.get(port).toString()));
        }
        command.addAll(options);
    }

    public URI api(String path) {
        return URI.create("http://127.0.0.1:" + ports.get("control") + path);
    }

    public URI dashboard() {
        return URI.create("http://127.0.0.1:" + ports.get("dashboard"));
    }

    /** Adds an option before the first start. */
    public void with(String option, String value) {
        command.addAll(List.of(option, value));
    }

    public int port(String name) {
        return ports.get(name);
    }

    /** The Java process of the suite, which replaced the script. */
    public ProcessHandle javaProcess() {
        return process.toHandle();
    }

    public String kafka() {
        return "127.0.0.1:" + ports.get("kafka");
    }

    /** Returns once it is ready. */
    public void start() throws IOException {
        process = new ProcessBuilder(command)
                .redirectErrorStream(true)
                .redirectOutput(ProcessBuilder.Redirect.appendTo(
                        folder.resolve("up.out").toFile()))
                .start();
        boolean isAnswered = Until.within(START_TIMEOUT, () -> !process.isAlive() || isReady());
        if (!isAnswered || !process.isAlive()) {
            throw new IOException("up %s: %s%n%s"
                    .formatted(
                            isAnswered
                                    ? "ended while it started"
                                    : "is not ready within " + START_TIMEOUT.toSeconds() + " s",
                            readiness(),
                            Files.readString(folder.resolve("up.out"))));
        }
    }

    private boolean isReady() {
        return readiness().path("status").asText().equals("ready");
    }

    private JsonNode readiness() {
        return Http.get(URI.create("http://127.0.0.1:" + ports.get("health") + "/ready"))
                .body();
    }

    /** Kills the process like {@code kill -9}. */
    public void kill() throws InterruptedException {
        process.destroyForcibly().waitFor();
    }

    /** Reads a path of the REST API. */
    public JsonNode get(String path) {
        return Http.get(api(path)).body();
    }

    /** Runs a command of {@code ./furrow} to its end. @return its output */
    public String run(String... arguments) throws IOException, InterruptedException {
        List<String> all = new ArrayList<>(furrow);
        all.addAll(List.of(arguments));
        all.addAll(List.of("--api", api("").toString()));
        Path output = Files.createTempFile(folder, "command", ".out");
        Process started = new ProcessBuilder(all)
                .redirectErrorStream(true)
                .redirectOutput(output.toFile())
                .start();
        if (!started.waitFor(COMMAND_SECONDS, TimeUnit.SECONDS)) {
            started.destroyForcibly();
            throw new IOException("has not ended within %d s: %s".formatted(COMMAND_SECONDS, all));
        }
        String printed = Files.readString(output);
        Files.delete(output);
        if (started.exitValue() != 0) {
            throw new IOException("%s ended with %d: %s".formatted(all, started.exitValue(), printed));
        }
        return printed;
    }

    @Override
    public void close() {
        if (process == null) {
            return;
        }
        process.destroy();
        try {
            if (!process.waitFor(STOP_SECONDS, TimeUnit.SECONDS)) {
                process.destroyForcibly();
            }
        } catch (InterruptedException e) {
            process.destroyForcibly();
            Thread.currentThread().interrupt();
        }
    }
}
