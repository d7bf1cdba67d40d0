package io.furrow.provisioner;

import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;

import io.furrow.model.device.FarmSecret;

import static java.nio.charset.StandardCharsets.UTF_8;

/** An MQTT client that stores the newest message of each topic. */
final class MqttPeer implements AutoCloseable {
    private final MqttClient client;
    private final Map<String, String> newest = new ConcurrentHashMap<>();

    private MqttPeer(MqttClient client) {
        this.client = client;
    }

    static MqttPeer connect(String broker, FarmSecret.Login login, String clientId) throws MqttException {
        MqttClient client = new MqttClient(broker, clientId, new MemoryPersistence());
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName(login.user());
        options.setPassword(login.password().toCharArray());
        try {
            client.connect(options);
            return new MqttPeer(client);
        } catch (MqttException e) {
            client.close();
            throw e;
        }
    }

    MqttPeer subscribe(String filter) throws MqttException {
        client.subscribe(filter, 1, (topic, message) -> newest.put(topic, new String(message.getPayload(), UTF_8)));
        return this;
    }

    void publish(String topic, String message) throws MqttException {
        client.publish(topic, message.getBytes(UTF_8), 1, false);
    }

    /** Returns the newest message; empty if none arrived. */
    String newest(String topic) {
        return newest.getOrDefault(topic, "");
    }

    Set<String> topics() {
        return newest.keySet();
    }

    boolean isConnected() {
        return client.isConnected();
    }

    @Override
    public void close() throws MqttException {
        if (client.isConnected()) {
            client.disconnect();
        }
        client.close();
    }
}
