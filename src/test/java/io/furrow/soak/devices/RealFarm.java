package io.furrow.soak.devices;

import java.io.IOException;
import java.io.UncheckedIOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.atomic.AtomicBoolean;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.soak.control.Http;
import io.furrow.soak.control.MosquittoProcess;

/**
 * Starts a farm of processes: Mosquitto, the stand-ins of context broker and IoT Agent, and {@code ./furrow up} with
 * the options for both.
 */
final class RealFarm implements AutoCloseable {
    static final String WINDOW = "10s";

    private final Path log;
    final MosquittoProcess mosquitto;
    final StandInProcess standIn;
    final UpProcess up;
    private final AtomicBoolean closed = new AtomicBoolean();

    RealFarm(Path home, Path folder, ProgramPlan plan) throws IOException, InterruptedException {
        Path broker = folder.resolve("mosquitto").toAbsolutePath();
        log = broker.resolve("broker.log");
        mosquitto = new MosquittoProcess(broker, "log_dest file %s%nlog_type all".formatted(log));
        standIn = new StandInProcess(folder, mosquitto.uri());
        Path fields = Files.writeString(
                folder.resolve("fields.geojson"), plan.fields().toString());
        up = new UpProcess(
                home,
                folder.resolve("up"),
                List.of(
                        "--orion", standIn.contextBroker().toString(),
                        "--iot-agent", standIn.iotAgent().toString(),
                        "--iot-agent-interval", "5s",
                        "--mqtt-password-file", mosquitto.passwords().toString(),
                        "--mqtt-acl-file", mosquitto.rules().toString(),
                        "--mqtt-reload", mosquitto.reload(),
                        "--mqtt-log", log.toString(),
                        "--mqtt-public-url", mosquitto.uri().toString().replace("tcp:", "mqtt:"),
                        "--fields", fields.toString(),
                        "--window", WINDOW,
                        "--start-timeout", "20s"));
    }

    void start() throws IOException {
        mosquitto.start();
        standIn.start();
        up.start();
    }

    /**
     * How often the IoT Agent has subscribed to what devices send: it reconnects to the broker later than the devices.
     */
    long agentSubscriptions() {
        try (Stream<String> lines = Files.lines(log)) {
            return lines.filter(line -> line.endsWith(" 1 /json/+/+/cmdexe")).count();
        } catch (IOException e) {
            throw new UncheckedIOException(e);
        }
    }

    /** The entities of a type at the context broker. */
    JsonNode entities(String type) {
        return Http.get(
                        standIn.contextBroker().resolve("/v2/entities?limit=1000&type=" + type),
                        "fiware-service",
                        "farm",
                        "fiware-servicepath",
                        "/#")
                .body();
    }

    @Override
    public void close() {
        if (closed.compareAndSet(false, true)) {
            up.close();
            standIn.close();
            mosquitto.close();
        }
    }
}
