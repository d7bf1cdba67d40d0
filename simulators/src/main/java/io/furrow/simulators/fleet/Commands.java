package io.furrow.simulators.fleet;

import java.time.Duration;
import java.time.Instant;
import java.util.HashMap;
import java.util.Map;
import java.util.Optional;
import java.util.PriorityQueue;
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
 * What MQTT devices are told, and what they answer: {@code on} and {@code off} at once, {@code restart} when the device is there
 * again, {@link #RESTART} later.
 */
final class Commands {
    static final Duration RESTART = Duration.ofSeconds(2);

    private static final Logger LOG = LoggerFactory.getLogger(Commands.class);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;

    private final Scene scene;
    private final Connections connections;
    private final Consumer<Report> sends;
    private final Map<String, SimulatedDevice> devices = new HashMap<>();
    private final PriorityQueue<Restart> restarts = new PriorityQueue<>();

    /** A device that is there again at a time. */
    private record Restart(Instant until, SimulatedDevice device) implements Comparable<Restart> {
        @Override
        public int compareTo(Restart other) {
            return until.compareTo(other.until);
        }
    }

    /** @param sends what a device says because it was told something */
    Commands(Scene scene, Connections connections, Consumer<Report> sends) {
        this.scene = scene;
        this.connections = connections;
        this.sends = sends;
    }

    void add(SimulatedDevice device) {
        devices.put(device.id(), device);
    }

    void remove(String device) {
        devices.remove(device);
    }

    /** Lets devices do what they were told since the last time. */
    void obey(Instant now) {
        for (Optional<Connections.Command> next = connections.command();
                next.isPresent();
                next = connections.command()) {
            obey(next.get(), now);
        }
        while (!restarts.isEmpty() && !restarts.peek().until().isAfter(now)) {
            SimulatedDevice device = restarts.poll().device();
            if (devices.get(device.id()) == device) {
                connections.send(device.id(), "cmdexe", NODES.objectNode().put("restart", "ok"));
                scene.report(device, now).ifPresent(sends);
            }
        }
    }

    private void obey(Connections.Command told, Instant now) {
        SimulatedDevice device = devices.get(told.device());
        if (device == null) {
            return;
        }
        try {
            JsonNode json = NgsiJson.read(told.payload());
            ObjectNode results = NODES.objectNode();
            for (var names = json.fieldNames(); names.hasNext(); ) {
                String command = names.next();
                switch (command) {
                    case "on", "off" -> {
                        results.put(command, "ok");
                        scene.switchTo(device, command.equals("on"), now).ifPresent(sends);
                    }
                    case "restart" -> {
                        Instant until = now.plus(RESTART);
                        scene.restart(device.id(), until);
                        restarts.add(new Restart(until, device));
                    }
                    default -> results.put(command, "unknown command");
                }
            }
            if (!results.isEmpty()) {
                connections.send(device.id(), "cmdexe", results);
            }
        } catch (UnreadableException e) {
            LOG.warn("{} got a command that is no JSON: {}", device.id(), e.getMessage());
        }
    }
}
