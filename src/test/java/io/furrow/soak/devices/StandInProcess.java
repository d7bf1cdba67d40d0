package io.furrow.soak.devices;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.MosquittoProcess;
import io.furrow.soak.control.Until;

/**
 * Runs the stand-ins of context broker and IoT Agent as a process, which stores entities and devices in a file as the
 * real ones do in MongoDB.
 */
public final class StandInProcess implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(60);

    private final int contextBroker = FreePort.orFree(0);
    private final int iotAgent = FreePort.orFree(0);
    private final JavaProcess process;
    private final Path started;

    public StandInProcess(Path folder, URI mqtt) {
        started = folder.resolve("fiware.started");
        process = new JavaProcess(
                folder.resolve("fiware.out"),
                List.of("-Xmx384m", "-Dfurrow.log=" + folder.resolve("fiware.log")),
                StandInProcess.class.getName(),
                List.of(
                        Integer.toString(contextBroker),
                        Integer.toString(iotAgent),
                        mqtt.toString(),
                        folder.resolve("fiware.json.gz").toString(),
                        started.toString()));
    }

    /**
     * Runs until it is killed; arguments: both ports, MQTT broker, file for the state, file that is created after the
     * start.
     */
    public static void main(String... args) throws IOException, InterruptedException {
        FiwareStandIn.start(new FiwareSettings(
                        Integer.parseInt(args[0]),
                        Integer.parseInt(args[1]),
                        URI.create(args[2]),
                        MosquittoProcess.AGENT,
                        MosquittoProcess.AGENT_PASSWORD)
                .withState(Path.of(args[3])));
        Files.createFile(Path.of(args[4]));
        Thread.currentThread().join();
    }

    public URI contextBroker() {
        return URI.create("http://127.0.0.1:" + contextBroker);
    }

    URI iotAgent() {
        return URI.create("http://127.0.0.1:" + iotAgent);
    }

    /** Returns once it answers and receives from devices. */
    public void start() throws IOException {
        Files.deleteIfExists(started);
        process.start();
        Until.isTrue("the stand-in has started", START_TIMEOUT, () -> Files.exists(started));
    }

    void kill() throws InterruptedException {
        process.kill();
    }

    @Override
    public void close() {
        process.close();
    }
}
