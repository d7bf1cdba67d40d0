package io.furrow.launcher.suite;

import java.io.IOException;
import java.net.InetAddress;
import java.net.InetSocketAddress;
import java.net.ServerSocket;

import io.furrow.cli.CommandException;

/** Finds a port in use before anything is started on it. */
public final class PortCheck {
    private static final String LOOPBACK = "127.0.0.1";

    private PortCheck() {}

    /** @throws CommandException if somebody listens on a port that a suite of these settings needs */
    static void free(SuiteSettings settings) {
        SuiteSettings.Ports ports = settings.ports();
        if (settings.kafka() == null) {
            free(ports.kafka(), "Kafka", "--kafka-port");
        }
        free(ports.dashboard(), "the dashboard", "--dashboard-port");
        free(ports.connect(), "Connect", "--connect-port");
        free(ports.flink(), "Flink's web UI", "--flink-port");
        free(ports.listener(), "the listener for notifications", "--notify-port");
        free(ports.control(), "the control plane", "--control-port");
        free(ports.health(), "the control plane's health", "--health-port");
        if (settings.mongo() == null) {
            free(ports.mongo(), "the server for missions", "--mongo-port");
        }
        if (settings.orion() == null) {
            free(ports.mqtt(), "the MQTT broker", "--mqtt-port");
            free(ports.orion(), "the context broker", "--orion-port");
            free(ports.iotAgent(), "the IoT Agent", "--iot-agent-port");
        }
    }

    private static void free(int port, String what, String option) {
        free(LOOPBACK, port, what, option);
    }

    /**
     * @param host address of this machine, on which the port will be opened
     * @param option the option that sets the port
     * @throws CommandException if somebody listens there
     */
    public static void free(String host, int port, String what, String option) {
        if (port == 0) {
            return;
        }
        try (ServerSocket socket = new ServerSocket()) {
            socket.setReuseAddress(true); // a port that is only cooling down is free
            socket.bind(new InetSocketAddress(InetAddress.getByName(host), port));
        } catch (IOException e) {
            throw new CommandException(
                    "Port %d of %s, meant for %s, is in use. Stop what listens there, or choose another with %s."
                            .formatted(port, host, what, option),
                    e);
        }
    }
}
