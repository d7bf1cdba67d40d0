package io.furrow.simulators.load;

import java.io.IOException;
import java.util.concurrent.atomic.LongAdder;

import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
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
    private static final int QOS = 1;

    private final MqttAsyncClient client;
    private final LongAdder acknowledged = new LongAdder();

    private Gateway(MqttAsyncClient client) {
        this.client = client;
    }

    /** @param inflight how many messages may wait for their acknowledgement */
    static Gateway connect(FleetSettings settings, String name, int inflight) throws IOException {
        Gateway gateway = new Gateway(BrokerConnection.client(settings, name));
        gateway.client.setCallback(gateway);
        boolean connected = false;
        try {
            // The session is kept, so that what is in flight when the connection breaks is sent again.
            BrokerConnection.connect(gateway.client, settings, inflight, false);
            connected = true;
            return gateway;
        } finally {
            if (!connected) {
                gateway.close();
            }
        }
    }

    /** Whether the message is on its way; false while too many are, or while the connection is broken: try again. */
    boolean offer(String topic, byte[] payload) throws MqttException {
        try {
            client.publish(topic, payload, QOS, false);
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

    long acknowledged() {
        return acknowledged.sum();
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        acknowledged.increment();
    }

    @Override
    public void connectionLost(Throwable cause) {
        LOG.warn("{} lost its connection and tries again: {}", client.getClientId(), cause.getMessage());
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) {
        // Subscribed to nothing.
    }

    @Override
    public void close() {
        BrokerConnection.close(client);
    }
}
