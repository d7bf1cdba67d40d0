package io.furrow.bench.fleet;

import java.net.URI;
import java.nio.charset.StandardCharsets;
import java.util.Map;
import java.util.concurrent.ConcurrentHashMap;

import org.HdrHistogram.Histogram;
import org.eclipse.paho.client.mqttv3.IMqttDeliveryToken;
import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttCallback;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.MqttMessage;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;

/** Subscribes to all measures and counts them by device. */
final class MeasureListener implements MqttCallback, AutoCloseable {
    /** MQTT user with access to all topics, and its password. */
    static final String USER = "bench-listener";

    private static final String TIME = "\"time\":";
    private static final long MAX_MS = 60_000;

    private final MqttAsyncClient client;
    private final Map<String, Integer> byTopic = new ConcurrentHashMap<>();
    private final Histogram delays = new Histogram(MAX_MS, 3);
    private volatile MqttException broken;
    private volatile boolean counting;
    private long arrived;

    MeasureListener(URI mqtt) throws MqttException {
        client = new MqttAsyncClient(mqtt.toString(), USER, new MemoryPersistence());
        client.setCallback(this);
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName(USER);
        options.setPassword(USER.toCharArray());
        client.connect(options).waitForCompletion();
        client.subscribe("/+/+/attrs", 0).waitForCompletion();
    }

    void begin() {
        counting = true;
    }

    void end() throws MqttException {
        counting = false;
        if (broken != null) {
            throw broken;
        }
    }

    @Override
    public synchronized void messageArrived(String topic, MqttMessage message) {
        if (counting) {
            arrived++;
            byTopic.merge(topic, 1, Integer::sum);
            String json = new String(message.getPayload(), StandardCharsets.UTF_8);
            int from = json.indexOf(TIME) + TIME.length();
            long due = Long.parseLong(json, from, json.indexOf(',', from), 10);
            delays.recordValue(Math.max(0, Math.min(MAX_MS, System.currentTimeMillis() - due)));
        }
    }

    synchronized long arrived() {
        return arrived;
    }

    /** Number of devices that have reported. */
    int devices() {
        return byTopic.size();
    }

    synchronized long delay(double percentile) {
        return delays.getValueAtPercentile(percentile);
    }

    @Override
    public void connectionLost(Throwable cause) {
        broken = cause instanceof MqttException mqtt ? mqtt : new MqttException(cause);
    }

    @Override
    public void deliveryComplete(IMqttDeliveryToken token) {
        // It publishes nothing.
    }

    @Override
    public void close() {
        try {
            client.disconnectForcibly(0, 100);
            client.close();
        } catch (MqttException e) {
            throw new IllegalStateException("the listener could not be closed", e);
        }
    }
}
