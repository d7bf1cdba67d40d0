package io.furrow.simulators.device;

import java.io.IOException;
import java.util.UUID;

import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/** Opens and closes MQTT 3.1.1 connections with user and password that come back by themselves when they break. */
public final class BrokerConnection {
    private static final Logger LOG = LoggerFactory.getLogger(BrokerConnection.class);
    private static final int CONNECT_SECONDS = 10;
    private static final long CLOSE_MS = 2_000;
    private static final int LONGEST_PAUSE_MS = 5_000;

    private BrokerConnection() {}

    /** A client that is not connected yet; its id is the name with a random end, so that two fleets do not evict each other. */
    public static MqttAsyncClient client(FleetSettings settings, String name) throws IOException {
        String id = name + "-" + UUID.randomUUID().toString().substring(0, 8);
        try {
            return new MqttAsyncClient(address(settings), id, new MemoryPersistence());
        } catch (MqttException | IllegalArgumentException e) {
            throw new IOException(settings.mqtt() + " is no address of an MQTT broker: use tcp://host:port", e);
        }
    }

    /**
     * Connects.
     *
     * @param inflight how many messages may wait for their acknowledgement
     * @param cleanSession false to keep what is in flight over a break
     * @throws IOException naming broker and user
     */
    public static void connect(MqttAsyncClient client, FleetSettings settings, int inflight, boolean cleanSession)
            throws IOException {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setMqttVersion(MqttConnectOptions.MQTT_VERSION_3_1_1);
        options.setUserName(settings.mqttUser());
        options.setPassword(settings.mqttPassword().toCharArray());
        options.setCleanSession(cleanSession);
        options.setAutomaticReconnect(true);
        options.setMaxReconnectDelay(LONGEST_PAUSE_MS);
        options.setConnectionTimeout(CONNECT_SECONDS);
        options.setMaxInflight(inflight);
        if (address(settings).startsWith("tcp:")) {
            options.setSocketFactory(new NoDelaySockets());
        }
        try {
            client.connect(options).waitForCompletion();
        } catch (MqttException e) {
            throw new IOException(refusal(settings, e.getReasonCode()), e);
        }
    }

    /** Disconnects within two seconds, also when the broker is gone. */
    public static void close(MqttAsyncClient client) {
        try {
            client.setCallback(null);
            if (client.isConnected()) {
                client.disconnect(0).waitForCompletion(CLOSE_MS);
            }
        } catch (MqttException e) {
            LOG.debug("{} could not say goodbye to its broker", client.getClientId(), e);
        } finally {
            closeForcibly(client);
        }
    }

    private static void closeForcibly(MqttAsyncClient client) {
        try {
            client.close(true);
        } catch (MqttException e) {
            LOG.warn("{} could not be closed", client.getClientId(), e);
        }
    }

    private static String refusal(FleetSettings settings, int reason) {
        return switch (reason) {
            case MqttException.REASON_CODE_FAILED_AUTHENTICATION, MqttException.REASON_CODE_NOT_AUTHORIZED ->
                "the MQTT broker %s refuses user '%s': check user name and password"
                        .formatted(settings.mqtt(), settings.mqttUser());
            default ->
                "no connection to the MQTT broker %s as user '%s': is it running?"
                        .formatted(settings.mqtt(), settings.mqttUser());
        };
    }

    private static String address(FleetSettings settings) {
        return settings.mqtt().toString().replaceFirst("^mqtt:", "tcp:").replaceFirst("^mqtts:", "ssl:");
    }
}
