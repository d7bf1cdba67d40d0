package io.furrow.simulators.load;

import java.io.IOException;
import java.util.concurrent.atomic.LongAdder;

import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttCallback;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.simulators.device.BrokerConnection;
import io.furrow.simulators.device.FleetSettings;

/** One MQTT connection that carries the measures of many devices at QoS 1 and counts their acknowledgements. */
final class Gateway implements MqttCallback, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(Gateway.class);

    private final BrokerConnection connection;
    private final int inflight;
    private final LongAdder acknowledged = new LongAdder();
    private long accepted;

    private Gateway(BrokerConnection connection, int inflight) {
        this.connection = connection;
        this.inflight = inflight;
    }

    /** @param inflight how many messages may wait for their acknowledgement */
    static Gateway connect(FleetSettings settings, String name, int inflight) throws IOException {
        Gateway gateway = new Gateway(BrokerConnection.to(settings, name), inflight);
        boolean connected = false;
        try {
            // The session is kept, so that what is in flight when the connection breaks is sent again.
            gateway.connection.open(gateway, 2 * inflight, false);
            connected = true;
            return gateway;
        } finally {
            if (!connected) {
                gateway.close();
            }
        }
    }

    /**
     * Whether the message is on its way; false while too many are, or while the connection is broken: try again. The limit
     * is counted here because the client counts what is written to the socket only: what waits before it has no bound.
     */
    boolean offer(String topic, byte[] payload) throws MqttException {
        if (!ready() || accepted - acknowledged.sum() >= inflight) {
            return false;
        }
        try {
            connection.publish(topic, payload);
            accepted++;
            return true;
        } catch (MqttException e) {
            return switch (e.getReasonCode()) {
                case MqttException.REASON_CODE_MAX_INFLIGHT,
                        MqttException.REASON_CODE_CLIENT_NOT_CONNECTED,
                        MqttException.REASON_CODE_CONNECTION_LOST -> false;
                default -> throw e;
            };
        }
    }

    /** Whether it is open; if not, tries to open it again, upon which it sends again what was in flight. */
    boolean ready() {
        return connection.ready();
    }

    long acknowledged() {
        return acknowledged.sum();
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        acknowledged.increment();
    }

    @Override
    public void connectionLost(Throwable cause) {
        LOG.warn("{} lost its connection and tries again: {}", connection, cause.getMessage());
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) {
        // Subscribed to nothing.
    }

    @Override
    public void close() {
        connection.close();
    }
}
