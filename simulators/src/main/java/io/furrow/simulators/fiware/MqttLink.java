package io.furrow.simulators.fiware;

import java.net.URI;
import java.util.Arrays;
import java.util.UUID;

import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttCallbackExtended;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

/**
 * The agent's MQTT side: {@code /<apikey>/<device>/attrs} and {@code …/cmdexe} in, {@code …/cmd} out, each also read with the
 * prefix {@code /json}. QoS 1 in a kept session: what comes while the connection is down is delivered after it.
 */
final class MqttLink implements IotAgent.Downlink, MqttCallbackExtended, AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(MqttLink.class);
    private static final String[] FILTERS = {"/+/+/attrs", "/json/+/+/attrs", "/+/+/cmdexe", "/json/+/+/cmdexe"};
    private static final int MAX_INFLIGHT = 10_000;
    private static final int CONNECT_SECONDS = 10;
    private static final int MAX_RECONNECT_MS = 5_000;
    private static final long WAIT_MS = 10_000;
    private static final long CLOSE_MS = 2_000;

    private final IotAgent agent;
    private final MqttAsyncClient client;

    /** @throws IllegalStateException if the broker cannot be reached or refuses the user */
    static MqttLink open(FiwareSettings settings, IotAgent agent) {
        try {
            String name = "furrow-iot-agent-" + UUID.randomUUID().toString().substring(0, 8);
            MqttLink link = new MqttLink(settings.mqttBroker(), name, agent);
            link.client.setCallback(link);
            link.client.connect(options(settings)).waitForCompletion(WAIT_MS);
            link.client.subscribe(FILTERS, qos()).waitForCompletion(WAIT_MS);
            return link;
        } catch (MqttException e) {
            throw new IllegalStateException(
                    "the IoT agent cannot use the MQTT broker at " + settings.mqttBroker()
                            + "; is it running, are user and password right?",
                    e);
        }
    }

    private MqttLink(URI broker, String clientId, IotAgent agent) throws MqttException {
        this.agent = agent;
        this.client = new MqttAsyncClient(broker.toString(), clientId, new MemoryPersistence());
    }

    private static MqttConnectOptions options(FiwareSettings settings) {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setCleanSession(false);
        options.setAutomaticReconnect(true);
        options.setMaxReconnectDelay(MAX_RECONNECT_MS);
        options.setConnectionTimeout(CONNECT_SECONDS);
        options.setMaxInflight(MAX_INFLIGHT);
        if ("tcp".equals(settings.mqttBroker().getScheme())) {
            options.setSocketFactory(new PromptSocketFactory());
        }
        if (settings.mqttUser() != null) {
            options.setUserName(settings.mqttUser());
            options.setPassword(settings.mqttPassword().toCharArray());
        }
        return options;
    }

    private static int[] qos() {
        int[] qos = new int[FILTERS.length];
        Arrays.fill(qos, 1);
        return qos;
    }

    @Override
    public void connectComplete(boolean reconnect, String serverUri) {
        if (!reconnect) {
            return;
        }
        try {
            // A broker that was restarted may have forgotten the session.
            client.subscribe(FILTERS, qos());
            LOG.info("The IoT agent is connected to {} again.", serverUri);
        } catch (MqttException e) {
            LOG.warn("The IoT agent could not subscribe again at {}: no measures until it reconnects", serverUri, e);
        }
    }

    @Override
    public void connectionLost(Throwable cause) {
        LOG.warn("The IoT agent lost its MQTT connection and tries to get it back: {}", cause.toString());
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) {
        String[] parts = topic.substring(1).split("/");
        int first = parts.length - 3;
        if (parts[parts.length - 1].equals("attrs")) {
            agent.measured(parts[first], parts[first + 1], message.getPayload());
        } else {
            agent.executed(parts[first], parts[first + 1], message.getPayload());
        }
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // Nothing waits for it: the device's answer is what counts.
    }

    @Override
    public boolean send(String apikey, String deviceId, byte[] command) {
        try {
            client.publish("/" + apikey + "/" + deviceId + "/cmd", command, 1, false);
            return true;
        } catch (MqttException e) {
            LOG.warn("A command for device {} was not sent: {}", deviceId, e.toString());
            return false;
        }
    }

    @Override
    public void close() {
        try {
            if (client.isConnected()) {
                // The session outlives the connection; without subscriptions nothing gathers in it.
                client.unsubscribe(FILTERS).waitForCompletion(CLOSE_MS);
                client.disconnect(CLOSE_MS).waitForCompletion(CLOSE_MS);
            }
            client.close(true);
        } catch (MqttException e) {
            LOG.warn("The IoT agent did not part from its MQTT broker properly: {}", e.toString());
        }
    }
}
