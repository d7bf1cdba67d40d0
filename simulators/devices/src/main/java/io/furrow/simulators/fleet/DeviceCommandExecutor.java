package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.function.Consumer;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;
import io.furrow.simulators.scenario.SimulatedDevice;

/**
 * Executes commands of MQTT devices and answers them: {@code on} and {@code off} at once, {@code restart} after {@link
 * #RESTART}.
 */
final class DeviceCommandExecutor {
    static final Duration RESTART = Duration.ofSeconds(2);

    private static final Logger LOG = LoggerFactory.getLogger(DeviceCommandExecutor.class);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final FarmSimulation simulation;
    private final Connections connections;
    private final Consumer<Report> sends;
    private final Map<String, SimulatedDevice> devices = new HashMap<>();
    /** Devices that are restarting, and until when. */
    private final Map<String, Instant> restarts = new HashMap<>();

    /** @param sends publishes the report that a command causes */
    DeviceCommandExecutor(FarmSimulation simulation, Connections connections, Consumer<Report> sends) {
        this.simulation = simulation;
        this.connections = connections;
        this.sends = sends;
    }

    void add(SimulatedDevice device) {
        devices.put(device.id(), device);
    }

    void remove(String device) {
        devices.remove(device);
        restarts.remove(device);
    }

    /** Executes the commands received since the last call, and ends restarts. */
    void obey(Instant now) {
        for (Optional<Connections.Command> next = connections.command();
                next.isPresent();
                next = connections.command()) {
            obey(next.get(), now);
        }
        restarts.entrySet().removeIf(each -> {
            boolean over = !each.getValue().isAfter(now);
            if (over) {
                connections.send(each.getKey(), "cmdexe", NODES.objectNode().put("restart", "ok"));
                simulation.report(devices.get(each.getKey()), now).ifPresent(sends);
            }
            return over;
        });
    }

    private void obey(Connections.Command received, Instant now) {
        SimulatedDevice device = devices.get(received.device());
        if (device == null) {
            return;
        }
        try {
            JsonNode json = NgsiJson.read(received.payload());
            ObjectNode results = NODES.objectNode();
            for (var names = json.fieldNames(); names.hasNext(); ) {
                String command = names.next();
                switch (command) {
                    case "on", "off" -> {
                        results.put(command, "ok");
                        simulation.switchTo(device, command.equals("on"), now).ifPresent(sends);
                    }
                    case "restart" -> {
                        Instant until = now.plus(RESTART);
                        simulation.restart(device.id(), until);
                        restarts.put(device.id(), until);
                    }
                    default -> results.put(command, "unknown command");
                }
            }
            if (!results.isEmpty()) {
                connections.send(device.id(), "cmdexe", results);
            }
        } catch (UnreadableException e) {
            LOG.warn("{} received a command that is not valid JSON: {}", device.id(), e.getMessage());
        }
    }
}
