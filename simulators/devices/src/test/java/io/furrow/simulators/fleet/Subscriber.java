package io.furrow.simulators.fleet;

import java.io.BufferedReader;
import java.io.IOException;
import java.io.UncheckedIOException;
import java.lang.ProcessBuilder.Redirect;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.mqtt.MqttAccess;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * Receives all measures, each as its topic and payload, by {@code mosquitto_sub}. This ends when the broker stops in a
 * TLS handshake, and is then started again. Its session outlives the broker's restarts, so that it misses none.
 */
final class Subscriber implements AutoCloseable {
    private final FleetMosquitto broker;
    private final String name;
    private final Set<String> measures = ConcurrentHashMap.newKeySet();
    private Process client;
    private boolean isClosed;

    private Subscriber(FleetMosquitto broker, String name) {
        this.broker = broker;
        this.name = name;
    }

    static Subscriber to(FleetMosquitto broker, String name) throws Exception {
        Subscriber subscriber = new Subscriber(broker, name);
        assertThat(subscriber.start("-E").waitFor())
                .as("status of mosquitto_sub, which ends when its subscription is acknowledged")
                .isZero();
        subscriber.startAgain();
        new Thread(subscriber::receive).start();
        return subscriber;
    }

    Set<String> measures() {
        return measures;
    }

    private void receive() {
        do {
            try (BufferedReader lines = client.inputReader(UTF_8)) {
                lines.lines().forEach(measures::add);
            } catch (IOException | UncheckedIOException e) {
                // The client was stopped while a line was read.
            }
        } while (startAgain());
    }

    private synchronized boolean startAgain() {
        if (!isClosed) {
            client = start("-F", "%t %p");
        }
        return !isClosed;
    }

    private Process start(String... options) {
        List<String> command = new ArrayList<>(List.of("mosquitto_sub", "-h", "127.0.0.1", "-u", "farmer"));
        command.addAll(List.of("-P", "plough", "-i", name, "-c", "-q", "1", "-t", "/+/+/attrs", "-p"));
        command.add(Integer.toString(broker.uri().getPort()));
        command.addAll(List.of("--cafile", broker.certificate().toString()));
        command.addAll(List.of(options));
        try {
            return new ProcessBuilder(command).redirectError(Redirect.DISCARD).start();
        } catch (IOException e) {
            throw new UncheckedIOException("mosquitto_sub of the Debian package mosquitto-clients", e);
        }
    }

    /** With the user of the settings for all devices, at QoS 1. */
    static FleetAccess access(FleetSettings settings) {
        MqttAccess.Login login = new MqttAccess.Login(settings.mqttUser(), settings.mqttPassword());
        return new FleetAccess(settings, new MqttAccess(settings.mqtt(), null, 1), FleetAccess.Logins.all(login));
    }

    @Override
    public synchronized void close() {
        isClosed = true;
        client.destroy();
    }
}
