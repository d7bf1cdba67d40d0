package io.furrow.soak.devices;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;

import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.Mosquitto;
import io.furrow.soak.control.Until;

/** The stand-ins of context broker and IoT Agent in a process of their own, which keeps entities and devices in a file as those do in MongoDB. */
final class StandInProcess implements AutoCloseable {
    private static final Duration START_TIMEOUT = Duration.ofSeconds(60);

    private final int contextBroker = FreePort.orFree(0);
    private final int iotAgent = FreePort.orFree(0);
    private final JavaProcess process;

    StandInProcess(Path folder, URI mqtt) {
        process = new JavaProcess(
                folder.resolve("fiware.out"),
                List.of("-Xmx384m", "-Dfurrow.log=" + folder.resolve("fiware.log")),
                StandInProcess.class.getName(),
                List.of(
                        Integer.toString(contextBroker),
                        Integer.toString(iotAgent),
                        mqtt.toString(),
                        folder.resolve("fiware.json.gz").toString()));
    }

    /** Runs until it is killed; arguments: both ports, MQTT broker, file of the state. */
    public static void main(String... args) throws InterruptedException {
        FiwareStandIn.start(new FiwareSettings(
                        Integer.parseInt(args[0]),
                        Integer.parseInt(args[1]),
                        URI.create(args[2]),
                        Mosquitto.AGENT,
                        Mosquitto.AGENT_PASSWORD)
                .withState(Path.of(args[3])));
        Thread.currentThread().join();
    }

    URI contextBroker() {
        return URI.create("http://127.0.0.1:" + contextBroker);
    }

    URI iotAgent() {
        return URI.create("http://127.0.0.1:" + iotAgent);
    }

    /** Returns when it answers. */
    void start() throws IOException {
        process.start();
        Until.isTrue(
                "the stand-in answers",
                START_TIMEOUT,
                () -> Http.get(contextBroker().resolve("/version")).status() != 0
                        && Http.get(iotAgent().resolve("/iot/about")).status() != 0);
    }

    void kill() throws InterruptedException {
        process.kill();
    }

    @Override
    public void close() {
        process.close();
    }
}
