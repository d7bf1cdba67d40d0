package io.furrow.simulators.fiware;

import java.io.EOFException;
import java.io.IOException;
import java.util.List;
import java.util.UUID;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.simulators.fiware.MqttPackets.Message;

/**
 * The agent's MQTT side: {@code /<apikey>/<device>/attrs} and {@code …/cmdexe} in, {@code …/cmd} out (QoS 0, as the agent's
 * default), the former also with the prefix {@code /json}. QoS 1 in a kept session: what comes while the connection is down is
 * delivered after it.
 *
 * <p>It speaks MQTT 3.1.1 itself because Paho takes a received message apart byte by byte through a synchronized stream:
 * 3.4 ms of processor time for 100 kB, most of a core at 250 messages a second.
 */
final class MqttLink implements IotAgent.Downlink, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MqttLink.class);
    private static final List<String> FILTERS =
            List.of("/+/+/attrs", "/json/+/+/attrs", "/+/+/cmdexe", "/json/+/+/cmdexe");
    private static final int FIRST_ATTEMPTS = 5;
    private static final long FIRST_PAUSE_MS = 250;
    private static final long LONGEST_PAUSE_MS = 5_000;
    private static final long CLOSE_MS = 2_000;

    private final FiwareSettings settings;
    private final IotAgent agent;
    private final String clientId =
            "furrow-iot-agent-" + UUID.randomUUID().toString().substring(0, 8);
    private final CountDownLatch closing = new CountDownLatch(1);
    private final Thread receiver = new Thread(this::keepReceiving, "furrow-iot-agent-mqtt");
    private volatile MqttConnection connection;

    /** @throws IllegalStateException if the broker cannot be reached or refuses the user */
    static MqttLink open(FiwareSettings settings, IotAgent agent) {
        MqttLink link = new MqttLink(settings, agent);
        try {
            link.connectFirst();
        } catch (IOException | IllegalArgumentException e) {
            throw new IllegalStateException(
                    "the IoT agent cannot use the MQTT broker at " + settings.mqttBroker()
                            + "; is it running, are user and password right?",
                    e);
        }
        link.receiver.setDaemon(true);
        link.receiver.start();
        return link;
    }

    private MqttLink(FiwareSettings settings, IotAgent agent) {
        this.settings = settings;
        this.agent = agent;
    }

    @Override
    public boolean send(String apikey, String deviceId, byte[] command) {
        try {
            connection.publish("/" + apikey + "/" + deviceId + "/cmd", command);
            return true;
        } catch (IOException e) {
            LOG.warn("A command for device {} was not sent: {}", deviceId, e.toString());
            return false;
        }
    }

    @Override
    public void close() {
        closing.countDown();
        try (MqttConnection last = connection) {
            last.leave(FILTERS);
            receiver.join(CLOSE_MS);
        } catch (IOException e) {
            LOG.debug("The MQTT connection was gone before it was closed", e);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }

    /** Moquette now and then closes a connection that subscribes right after it was accepted; the next one stays. */
    private void connectFirst() throws IOException {
        for (int attempt = 1; attempt < FIRST_ATTEMPTS; attempt++) {
            try {
                connect();
                return;
            } catch (EOFException e) {
                LOG.debug("The MQTT broker closed connection {}", attempt, e);
                if (pausedUntilClosing(FIRST_PAUSE_MS)) {
                    return;
                }
            }
        }
        connect();
    }

    private void connect() throws IOException {
        MqttConnection opened = MqttConnection.open(settings, clientId, this::received);
        connection = opened;
        boolean subscribed = false;
        try {
            opened.subscribe(FILTERS);
            subscribed = true;
        } finally {
            if (!subscribed) {
                opened.close();
            }
        }
    }

    private void keepReceiving() {
        do {
            try (MqttConnection current = connection) {
                if (!isClosing()) {
                    current.receive();
                }
            } catch (IOException e) {
                if (!isClosing()) {
                    LOG.warn("The IoT agent lost its MQTT connection and tries to get it back: {}", e.toString());
                }
            }
        } while (reconnected());
    }

    /** Tries until it succeeds or until this link is closed. */
    private boolean reconnected() {
        long pause = FIRST_PAUSE_MS;
        while (!pausedUntilClosing(pause)) {
            try {
                connect();
                LOG.info("The IoT agent is connected to {} again.", settings.mqttBroker());
                return true;
            } catch (IOException e) {
                LOG.debug("No MQTT connection yet", e);
                pause = Math.min(2 * pause, LONGEST_PAUSE_MS);
            }
        }
        return false;
    }

    private boolean isClosing() {
        return closing.getCount() == 0;
    }

    private boolean pausedUntilClosing(long millis) {
        try {
            return closing.await(millis, TimeUnit.MILLISECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
            return true;
        }
    }

    private void received(Message message) {
        String[] parts = message.topic().substring(1).split("/");
        int first = parts.length - 3;
        if (parts[parts.length - 1].equals("attrs")) {
            agent.measured(parts[first], parts[first + 1], message.payload());
        } else {
            agent.executed(parts[first], parts[first + 1], message.payload());
        }
    }
}
