package io.furrow.simulators.device;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayDeque;
import java.util.Deque;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttCallbackExtended;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.ngsi.Position;
import io.furrow.model.ngsi.UnreadableException;

/**
 * A device with an MQTT connection of its own: publishes measures at QoS 1, obeys {@code on} and {@code off}, and keeps up
 * to {@value #KEPT} measures while the broker is away.
 */
final class MqttDevice implements Device, MqttCallbackExtended {
    static final List<String> COMMANDS = List.of("on", "off");

    private static final Logger LOG = LoggerFactory.getLogger(MqttDevice.class);
    private static final JsonNodeFactory NODES = JsonNodeFactory.instance;
    private static final int KEPT = 200;

    private final BrokerConnection connection;
    private final String topic;
    private final Sensor sensor;
    private final Route route;
    private final Path path;
    private final Instant start;
    private final Deque<ObjectNode> waiting = new ArrayDeque<>();
    private volatile boolean on = true;
    private volatile boolean listening;

    private MqttDevice(BrokerConnection connection, String topic, Sensor sensor, Route route, Instant start) {
        this.connection = connection;
        this.topic = topic;
        this.sensor = sensor;
        this.route = route;
        this.path = route.path();
        this.start = start;
    }

    /**
     * A device that is connected and listens to its commands.
     *
     * @param topic {@code /<apikey>/<device>}
     * @param start when it sets out on its route
     */
    static MqttDevice connect(FleetSettings settings, String topic, Sensor sensor, Route route, Instant start)
            throws IOException {
        BrokerConnection connection = BrokerConnection.to(settings, topic.substring(topic.lastIndexOf('/') + 1));
        MqttDevice device = new MqttDevice(connection, topic, sensor, route, start);
        try {
            connection.open(device, KEPT, true);
            connection.subscribe(topic + "/cmd").waitForCompletion();
            device.listening = true;
            return device;
        } catch (MqttException e) {
            throw new IOException(
                    "user '%s' may not subscribe to %s/cmd at the MQTT broker %s"
                            .formatted(settings.mqttUser(), topic, settings.mqtt()),
                    e);
        } finally {
            if (!device.listening) {
                device.close();
            }
        }
    }

    @Override
    public void report(Instant now) {
        if (on) {
            waiting.add(measure(now));
        }
        if (waiting.size() > KEPT) {
            waiting.remove();
        }
        while (connection.ready() && !waiting.isEmpty()) {
            publish("/attrs", waiting.remove());
        }
    }

    @Override
    public void messageArrived(String from, MqttMessage message) {
        try {
            JsonNode orders = NgsiJson.read(message.getPayload());
            orders.fieldNames().forEachRemaining(this::obey);
        } catch (UnreadableException e) {
            LOG.warn("{} got a command that is no JSON: {}", topic, e.getMessage());
        }
    }

    @Override
    public void connectComplete(boolean reconnect, String uri) {
        if (!listening) {
            return;
        }
        LOG.info("{} is connected again", topic);
        try {
            connection.subscribe(topic + "/cmd");
        } catch (MqttException e) {
            LOG.warn("{} hears no commands until it connects again", topic, e);
        }
    }

    @Override
    public void connectionLost(Throwable cause) {
        LOG.warn("{} lost its connection and tries again: {}", topic, cause.getMessage());
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // Nothing waits for it: the client repeats what is not acknowledged.
    }

    @Override
    public void close() {
        connection.close();
    }

    /** The last word of a device that is switched off says so, or its status would stay true. */
    private void obey(String command) {
        boolean known = COMMANDS.contains(command);
        if (known) {
            on = command.equals("on");
        }
        publish("/cmdexe", NODES.objectNode().put(command, known ? "ok" : "unknown command"));
        if (known && !on) {
            publish("/attrs", NODES.objectNode().put("stat", false).put("time", System.currentTimeMillis()));
        }
    }

    private ObjectNode measure(Instant now) {
        Position place = path.at(Duration.between(start, now));
        ObjectNode json = NODES.objectNode();
        json.set(sensor.attribute().objectId(), sensor.measure(now, place));
        return json.put("stat", true)
                .put("time", now.toEpochMilli())
                .put("lat", place.latitude())
                .put("lon", place.longitude())
                .put("where", route.where());
    }

    private void publish(String end, ObjectNode json) {
        try {
            connection.publish(topic + end, json.toString().getBytes(StandardCharsets.UTF_8));
        } catch (MqttException e) {
            LOG.warn("{}{} lost a message: {}", topic, end, e.getMessage());
        }
    }
}
