package io.furrow.simulators.device;

import java.util.List;
import java.util.UUID;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

import static java.nio.charset.StandardCharsets.UTF_8;

/** Another client of the MQTT broker: hears what devices say, and can say something. */
public final class MqttTestClient implements AutoCloseable {
    public record Heard(String topic, JsonNode json) {}

    private static final int ATTEMPTS = 5;
    private static final long TIMEOUT_MS = 15_000;

    private final List<Heard> received = new CopyOnWriteArrayList<>();
    private final MqttAsyncClient client;

    public MqttTestClient(FleetSettings settings) throws Exception {
        client = connected(settings);
    }

    /** Moquette 0.17 now and then drops a client that it has just accepted: connects again, as devices do. */
    private MqttAsyncClient connected(FleetSettings settings) throws Exception {
        for (int attempt = 1; ; attempt++) {
            String id = "listener-" + attempt + "-" + UUID.randomUUID();
            MqttAsyncClient opened = new MqttAsyncClient(settings.mqtt().toString(), id, new MemoryPersistence());
            try {
                MqttConnectOptions options = new MqttConnectOptions();
                options.setUserName(settings.mqttUser());
                options.setPassword(settings.mqttPassword().toCharArray());
                options.setMaxInflight(1000);
                opened.connect(options).waitForCompletion(TIMEOUT_MS);
                for (String topics : List.of("/+/+/attrs", "/+/+/cmdexe")) {
                    opened.subscribe(topics, 1, this::receive).waitForCompletion();
                }
                return opened;
            } catch (MqttException e) {
                close(opened);
                if (attempt == ATTEMPTS) {
                    throw e;
                }
            }
        }
    }

    private void receive(String topic, MqttMessage message) throws UnreadableException {
        received.add(new Heard(topic, NgsiJson.read(message.getPayload())));
    }

    public List<JsonNode> received(String topic) {
        return received.stream()
                .filter(message -> message.topic().equals(topic))
                .map(Heard::json)
                .toList();
    }

    public List<Heard> received() {
        return List.copyOf(received);
    }

    public void publish(String topic, String json) throws MqttException {
        client.publish(topic, json.getBytes(UTF_8), 1, false);
    }

    @Override
    public void close() {
        close(client);
    }

    private static void close(MqttAsyncClient client) {
        try {
            client.disconnectForcibly(0, 100, client.isConnected());
            client.close(true);
        } catch (MqttException e) {
            throw new IllegalStateException("a listener could not be closed", e);
        }
    }
}
