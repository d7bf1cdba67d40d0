package io.furrow.simulators.fleet;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.function.BiConsumer;

import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.simulators.mqtt.Line;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.Farm;
import io.furrow.simulators.scenario.SimulatedDevice;
import io.furrow.simulators.scenario.SimulatedDevice.Identity;

/**
 * The MQTT connections of a farm: of up to {@value #MOST_OWN} devices one each, of more one per mission, a gateway. The topics
 * are those of the device either way.
 */
final class Connections implements AutoCloseable {
    static final int MOST_OWN = 500;

    private final String apiKey;
    private final Map<String, Line> lines = new LinkedHashMap<>();
    private final List<Line> all = new ArrayList<>();

    private Connections(String apiKey) {
        this.apiKey = apiKey;
    }

    /**
     * Opens them.
     *
     * @param mostOwn how many devices have a connection of their own
     * @param heard is given device and payload of each command
     * @throws IOException if the broker is away or refuses; nothing is left open then
     */
    static Connections open(Farm farm, FleetAccess access, int mostOwn, BiConsumer<String, byte[]> heard)
            throws IOException {
        Connections connections = new Connections(farm.apiKey());
        boolean open = false;
        try {
            List<Identity> devices = farm.devices().stream()
                    .filter(device -> !(device instanceof SimulatedDevice.Robot))
                    .map(SimulatedDevice::identity)
                    .toList();
            if (devices.size() <= mostOwn) {
                for (Identity device : devices) {
                    connections.line(access, access.logins().device(device), device.id(), List.of(device), heard);
                }
            } else {
                Map<String, List<Identity>> missions = new LinkedHashMap<>();
                devices.forEach(device -> missions.computeIfAbsent(device.mission(), name -> new ArrayList<>())
                        .add(device));
                for (Map.Entry<String, List<Identity>> each : missions.entrySet()) {
                    connections.line(
                            access,
                            access.logins().gateway(each.getKey()),
                            "gateway-" + each.getKey(),
                            each.getValue(),
                            heard);
                }
            }
            open = true;
            return connections;
        } finally {
            if (!open) {
                connections.close();
            }
        }
    }

    private void line(
            FleetAccess access,
            MqttAccess.Login login,
            String name,
            List<Identity> devices,
            BiConsumer<String, byte[]> heard)
            throws IOException {
        Map<String, String> byTopic = new LinkedHashMap<>();
        devices.forEach(device -> byTopic.put(topic(device.id(), "cmd"), device.id()));
        Line line = Line.open(
                access.mqtt(),
                login,
                name,
                byTopic.keySet(),
                (topic, payload) -> heard.accept(byTopic.get(topic), payload));
        all.add(line);
        devices.forEach(device -> lines.put(device.id(), line));
    }

    /** @param end {@code attrs} or {@code cmdexe} */
    void send(String device, String end, ObjectNode json) {
        lines.get(device).send(topic(device, end), json.toString().getBytes(StandardCharsets.UTF_8));
    }

    /** Sends what waits and opens again what is broken. */
    void push() {
        all.forEach(Line::push);
    }

    int count() {
        return all.size();
    }

    long acknowledged() {
        return all.stream().mapToLong(Line::acknowledged).sum();
    }

    long unacknowledged() {
        return all.stream().mapToLong(Line::open).sum();
    }

    long dropped() {
        return all.stream().mapToLong(Line::dropped).sum();
    }

    @Override
    public void close() {
        all.parallelStream().forEach(Line::close);
    }

    private String topic(String device, String end) {
        return "/" + apiKey + "/" + device + "/" + end;
    }
}
