package io.furrow.simulators.fleet;

import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import org.eclipse.paho.client.mqttv3.MqttAsyncClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;

import io.furrow.model.ngsi.NgsiJson;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.mqtt.MqttAccess;

/** Receives all measures, each as its topic and time; its session outlives the broker's restarts, so that it misses none. */
record Subscriber(MqttAsyncClient client, Set<String> received) implements AutoCloseable {
    static Subscriber to(FleetMosquitto broker, String name) throws Exception {
        MqttAsyncClient client = new MqttAsyncClient(broker.uri().toString(), name, new MemoryPersistence());
        Set<String> measures = ConcurrentHashMap.newKeySet();
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName("farmer");
        options.setPassword("plough".toCharArray());
        options.setCleanSession(false);
        options.setAutomaticReconnect(true);
        options.setMaxReconnectDelay(1_000);
        options.setConnectionTimeout(10);
        options.setSocketFactory(new MqttAccess(broker.uri(), broker.certificate(), 1).encryptedSockets());
        client.connect(options).waitForCompletion();
        client.subscribe(
                        "/+/+/attrs",
                        1,
                        (topic, message) -> measures.add(topic + " "
                                + NgsiJson.read(message.getPayload()).path("time")))
                .waitForCompletion();
        return new Subscriber(client, measures);
    }

    Set<String> measures() {
        return received;
    }

    /** With the user of the settings for all devices, at QoS 1. */
    static FleetAccess access(FleetSettings settings) {
        MqttAccess.Login login = new MqttAccess.Login(settings.mqttUser(), settings.mqttPassword());
        return new FleetAccess(settings, new MqttAccess(settings.mqtt(), null, 1), FleetAccess.Logins.all(login));
    }

    @Override
    public void close() throws MqttException {
        client.disconnectForcibly(0, 100);
        client.close(true);
    }
}
