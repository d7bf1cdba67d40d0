package io.furrow.launcher.suite;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;
import java.util.ArrayList;
import java.util.List;
import java.util.stream.Collectors;

import io.furrow.cli.option.CommandException;

/** Finds all ports in use before anything is started on them. */
public final class PortCheck {
    private final List<Port> ports = new ArrayList<>();

    private record Port(String host, int number, String what, String option) {}

    /** @throws CommandException if a port that a suite with these settings needs is in use */
    static void free(SuiteSettings settings) {
        SuiteSettings.Ports ports = settings.ports();
        String loopback = InetAddress.getLoopbackAddress().getHostAddress();
        SuiteSettings.Listening listening = settings.fiware().listening();
        PortCheck check = new PortCheck();
        if (settings.kafka() == null) {
            check.add(loopback, ports.kafka(), "Kafka", "--kafka-port");
        }
        check.add(loopback, ports.dashboard(), "the dashboard", "--dashboard-port")
                .add(loopback, ports.connect(), "Connect", "--connect-port")
                .add(loopback, ports.flink(), "Flink's web UI", "--flink-port")
                .add(listening.host(), ports.listener(), "the listener for notifications", "--notify-port")
                .add(loopback, ports.control(), "the control plane", "--control-port")
                .add(loopback, ports.health(), "the control plane's health", "--health-port");
        if (settings.mongo() == null) {
            check.add(loopback, ports.mongo(), "the server for missions", "--mongo-port");
        }
        if (settings.orion() == null) {
            check.add(listening.mqttHost(), ports.mqtt(), "the MQTT broker", "--mqtt-port")
                    .add(loopback, ports.orion(), "the context broker", "--orion-port")
                    .add(loopback, ports.iotAgent(), "the IoT Agent", "--iot-agent-port");
        }
        check.requireFree();
    }

    /**
     * @param host local address on which the port will be opened
     * @param number 0 for a free one
     * @param option the option that sets the port
     */
    public PortCheck add(String host, int number, String what, String option) {
        ports.add(new Port(host, number, what, option));
        return this;
    }

    /** @throws CommandException naming each port that is in use, or configured twice */
    public void requireFree() {
        List<Port> taken = new ArrayList<>();
        List<ServerSocket> held = new ArrayList<>(); // until all are checked, so that no two parts share a port
        try {
            for (Port port : ports) {
                if (port.number() != 0 && !take(port, held)) {
                    taken.add(port);
                }
            }
            for (ServerSocket socket : held) {
                socket.close();
            }
        } catch (IOException e) {
            throw new CommandException("A port that was looked at cannot be closed: " + e.getMessage(), e);
        }
        if (taken.size() == 1) {
            Port port = taken.get(0);
            throw new CommandException(
                    "Port %d of %s, meant for %s, is in use. Stop what listens there, or choose another with %s."
                            .formatted(port.number(), port.host(), port.what(), port.option()));
        } else if (!taken.isEmpty()) {
            throw new CommandException(taken.stream()
                    .map(port ->
                            "%d of %s for %s (%s)".formatted(port.number(), port.host(), port.what(), port.option()))
                    .collect(Collectors.joining(
                            ", ",
                            "These ports are in use: ",
                            ". Stop what listens there, or choose others with the options in brackets.")));
        }
    }

    private static boolean take(Port port, List<ServerSocket> held) throws IOException {
        ServerSocket socket = new ServerSocket();
        held.add(socket);
        socket.setReuseAddress(true); // a port that is only cooling down is free
        try {
            socket.bind(new InetSocketAddress(InetAddress.getByName(port.host()), port.number()));
            return true;
        } catch (IOException e) {
            return false;
        }
    }
}
