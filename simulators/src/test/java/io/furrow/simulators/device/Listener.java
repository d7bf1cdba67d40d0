package io.furrow.simulators.device;

import java.nio.charset.StandardCharsets;
import java.util.List;
import java.util.concurrent.CopyOnWriteArrayList;

import com.fasterxml.jackson.databind.JsonNode;
import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttCallback;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.UnreadableException;

/** Another client of the MQTT broker: hears what devices say, and can say something. */
public final class Listener implements MqttCallback, AutoCloseable {
    public record Heard(String topic, JsonNode json) {}

    private final List<Heard> heard = new CopyOnWriteArrayList<>();
    private final BrokerConnection connection;

    public Listener(FleetSettings settings) throws Exception {
        connection = BrokerConnection.to(settings, "listener");
        connection.open(this, 1000, true);
        for (String topic : List.of("/+/+/attrs", "/+/+/cmdexe")) {
            connection.subscribe(topic).waitForCompletion();
        }
    }

    @Override
    public void messageArrived(String topic, MqttMessage message) throws UnreadableException {
        heard.add(new Heard(topic, NgsiJson.read(message.getPayload())));
    }

    @Override
    public void connectionLost(Throwable cause) {
        // The tests that break a connection listen elsewhere.
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // What devices answer shows whether it arrived.
    }

    public List<JsonNode> heard(String topic) {
        return heard.stream()
                .filter(message -> message.topic().equals(topic))
                .map(Heard::json)
                .toList();
    }

    public List<Heard> heard() {
        return List.copyOf(heard);
    }

    public void say(String topic, String json) throws MqttException {
        connection.publish(topic, json.getBytes(StandardCharsets.UTF_8));
    }

    @Override
    public void close() {
        connection.close();
    }
}
