package io.furrow.simulators.device;

import java.io.IOException;
import java.time.Duration;
import java.util.UUID;
import java.util.concurrent.TimeUnit;

import org.eclipse.paho.client.mqttv3.IMqttToken;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttCallback;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * An MQTT 3.1.1 connection with user and password. A broken one comes back when somebody asks whether it is
 * {@linkplain #ready() ready}; the client's own timer for that would outlive the connection.
 */
public final class BrokerConnection implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(BrokerConnection.class);
    private static final int QOS = 1;
    private static final int CONNECT_SECONDS = 10;
    /** Within which a broker accepts or refuses; Paho itself may wait for ever. */
    private static final Duration ANSWERED_WITHIN = Duration.ofSeconds(15);

    private static final long CLOSE_MS = 100;
    private static final long RETRY_NANOS = TimeUnit.SECONDS.toNanos(1);

    private final FleetSettings settings;
    private final MqttAsyncClient client;
    private long lastAttempt;
    private boolean closed;

    private BrokerConnection(FleetSettings settings, MqttAsyncClient client) {
        this.settings = settings;
        this.client = client;
    }

    /**
     * A connection that is not open yet.
     *
     * @param name start of the client id; its end is random, so that two fleets do not evict each other
     */
    public static BrokerConnection to(FleetSettings settings, String name) throws IOException {
        String id = name + "-" + UUID.randomUUID().toString().substring(0, 8);
        try {
            return new BrokerConnection(settings, new MqttAsyncClient(address(settings), id, new MemoryPersistence()));
        } catch (MqttException | IllegalArgumentException e) {
            throw new IOException(settings.mqtt() + " is no address of an MQTT broker: use tcp://host:port", e);
        }
    }

    /**
     * Opens it.
     *
     * @param inflight how many messages may wait for their acknowledgement
     * @param cleanSession false to send again, after a break, what was not acknowledged before it
     * @throws IOException naming broker and user
     */
    public void open(MqttCallback callback, int inflight, boolean cleanSession) throws IOException {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setMqttVersion(MqttConnectOptions.MQTT_VERSION_3_1_1);
        options.setUserName(settings.mqttUser());
        options.setPassword(settings.mqttPassword().toCharArray());
        options.setCleanSession(cleanSession);
        options.setConnectionTimeout(CONNECT_SECONDS);
        options.setMaxInflight(inflight);
        if (address(settings).startsWith("tcp:")) {
            options.setSocketFactory(new NoDelaySockets());
        }
        client.setCallback(callback);
        try {
            client.connect(options).waitForCompletion(ANSWERED_WITHIN.toMillis());
        } catch (MqttException e) {
            throw new IOException(refusal(e.getReasonCode()), e);
        }
    }

    /** Whether it is open; if not, tries once a second to open it again without waiting for the outcome. */
    public synchronized boolean ready() {
        if (client.isConnected()) {
            return true;
        }
        if (!closed && System.nanoTime() - lastAttempt > RETRY_NANOS) {
            lastAttempt = System.nanoTime();
            try {
                client.reconnect();
            } catch (MqttException e) {
                LOG.debug("{} is not connected yet", this, e);
            }
        }
        return false;
    }

    /** Publishes at QoS 1 without waiting for the acknowledgement. */
    public void publish(String topic, byte[] payload) throws MqttException {
        client.publish(topic, payload, QOS, false);
    }

    /** Subscribes at QoS 1; messages go to the callback. */
    public IMqttToken subscribe(String topic) throws MqttException {
        return client.subscribe(topic, QOS);
    }

    /** Disconnects within half a second or so, also when the broker hangs or is gone; a second time does nothing. */
    @Override
    public synchronized void close() {
        if (closed) {
            return;
        }
        closed = true;
        client.setCallback(null);
        try {
            client.disconnectForcibly(0, CLOSE_MS, client.isConnected());
        } catch (MqttException e) {
            LOG.debug("{} could not say goodbye", this, e);
        }
        try {
            client.close(true);
        } catch (MqttException e) {
            LOG.warn("{} could not be closed", this, e);
        }
    }

    /** Client id and broker. */
    @Override
    public String toString() {
        return client.getClientId() + " at " + settings.mqtt();
    }

    private String refusal(int reason) {
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
