package io.furrow.fiware;

import org.eclipse.paho.client.mqttv3.IMqttMessageListener;
import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;

import io.furrow.embedded.EmbeddedMqtt;

/** The connections of devices in tests, user {@code device} with the password {@code hidden}. */
public final class MqttDevice {
    private static final int ATTEMPTS = 5;

    private MqttDevice() {}

    /**
     * A connected client that has subscribed to its commands. Moquette 0.17 now and then drops a client that it has
     * just accepted, and may hang one whose id another has just given up, so this one connects as devices do: again,
     * and each time with another id.
     */
    public static MqttClient connect(EmbeddedMqtt broker, String commands, IMqttMessageListener listener)
            throws MqttException {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName("device");
        options.setPassword("hidden".toCharArray());
        for (int attempt = 1; ; attempt++) {
            MqttClient client =
                    new MqttClient(broker.uri().toString(), MqttClient.generateClientId(), new MemoryPersistence());
            try {
                client.setTimeToWait(10_000);
                client.connect(options);
                client.subscribe(commands, 1, listener);
                return client;
            } catch (MqttException e) {
                client.close(true);
                if (attempt == ATTEMPTS) {
                    throw e;
                }
            }
        }
    }
}
