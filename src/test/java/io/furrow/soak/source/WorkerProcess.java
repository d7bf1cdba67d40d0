package io.furrow.soak.source;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.embedded.FreePort;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.soak.control.Http;
import io.furrow.soak.control.JavaProcess;
import io.furrow.soak.control.Until;

/** Runs a distributed Connect worker as a process; it can be killed, stopped in order and started again. */
class WorkerProcess implements AutoCloseable {
    private static final Duration TIMEOUT = Duration.ofSeconds(120);

    private final Path folder;
    private final int restPort = FreePort.orFree(0);
    private final int jmxPort = FreePort.orFree(0);
    private final JavaProcess process;

    /**
     * @param folder for its log
     * @param environment additional variables
     * @param settings of the worker, {@code name=value}
     */
    WorkerProcess(Path folder, String bootstrapServers, Map<String, String> environment, List<String> settings) {
        this.folder = folder;
        List<String> options = List.of(
                "-Xmx384m",
                "-Dfurrow.log=" + log(),
                "-Djava.rmi.server.hostname=127.0.0.1",
                "-Dcom.sun.management.jmxremote.host=127.0.0.1",
                "-Dcom.sun.management.jmxremote.port=" + jmxPort,
                "-Dcom.sun.management.jmxremote.rmi.port=" + jmxPort,
                "-Dcom.sun.management.jmxremote.authenticate=false",
                "-Dcom.sun.management.jmxremote.ssl=false");
        List<String> arguments = new ArrayList<>(
                List.of(bootstrapServers, System.getProperty("furrow.plugins"), Integer.toString(restPort)));
        arguments.addAll(settings);
        process = new JavaProcess(folder.resolve("worker.out"), options, WorkerMain.class.getName(), arguments)
                .with(environment);
        Runtime.getRuntime().addShutdownHook(new Thread(process::close));
    }

    void start() throws IOException {
        process.start();
    }

    /** A path below the connectors of its REST API. */
    URI connectors(String path) {
        return URI.create("http://127.0.0.1:" + restPort + "/connectors" + path);
    }

    Path log() {
        return folder.resolve("worker.log");
    }

    /** The port for JMX. */
    int jmxPort() {
        return jmxPort;
    }

    /** Creates or changes a connector once the worker accepts it. */
    void createConnector(String name, JsonNode config) {
        Until.isTrue(
                "the worker accepts the connector",
                TIMEOUT,
                () -> Http.send("PUT", connectors("/" + name + "/config"), NgsiJson.write(config))
                                        .join()
                                        .status()
                                / 100
                        == 2);
    }

    /** Resident memory in MiB, from Linux' proc; 0 on other systems. */
    long residentMib() throws IOException {
        return statusMib("VmRSS:");
    }

    /** Peak resident memory in MiB, from Linux' proc; 0 on other systems. */
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

    /** Kills the process like {@code kill -9}. */
    void kill() throws InterruptedException {
        process.kill();
    }

    /** Stops the process, and kills it at a timeout. */
    @Override
    public void close() {
        try {
            process.stop();
        } catch (InterruptedException e) {
            process.close();
            Thread.currentThread().interrupt();
        }
    }
}
