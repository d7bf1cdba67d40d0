package io.furrow.provisioner;

import java.util.List;
import java.util.Map;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;

import org.eclipse.paho.client.mqttv3.MqttClient;
import org.eclipse.paho.client.mqttv3.MqttConnectOptions;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.eclipse.paho.client.mqttv3.persist.MemoryPersistence;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.device.FarmSecret;
import io.furrow.provisioner.account.InMemoryAccounts;
import io.furrow.provisioner.account.MqttAccount;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** Adds and removes accounts of the embedded MQTT broker. */
@Tag("full")
class EmbeddedBrokerTest {
    private static final InMemoryAccounts ACCOUNTS = new InMemoryAccounts();
    private static final String KEY = "/" + SECRET.apiKey("hoeing");
    private static final long TIMEOUT_MS = 20_000;
    private static final FarmSecret.Login DEVICE = SECRET.device("hoeing", "d");

    @AutoClose
    private static EmbeddedMqtt mqtt;

    private final Map<String, String> received = new ConcurrentHashMap<>();
    private MqttClient agent;

    @BeforeAll
    static void startBroker() {
        mqtt = EmbeddedMqtt.start(
                0,
                Map.of("agent", "plough"),
                new EmbeddedMqtt.Users(
                        ACCOUNTS::authenticates, ACCOUNTS::exists, ACCOUNTS::mayWrite, ACCOUNTS::mayRead));
    }

    @BeforeEach
    void listen() throws MqttException {
        ACCOUNTS.replace(
                List.of(MqttAccount.device(SECRET, "hoeing", "d"), MqttAccount.gateway(SECRET, "hoeing")), Set.of());
        agent = connect(new FarmSecret.Login("agent", "plough"));
        agent.subscribe("#", 1, (topic, message) -> received.put(topic, new String(message.getPayload(), UTF_8)));
    }

    @AfterEach
    void stop() throws MqttException {
        leave(agent);
    }

    @Test
    void allowsADeviceToPublishOnlyAsItself() throws MqttException {
        MqttClient device = connect(DEVICE);
        device.publish(KEY + "/e/attrs", "forged".getBytes(UTF_8), 0, false);
        device.publish(KEY + "/d/attrs", "1".getBytes(UTF_8), 1, false);

        await().until(() -> "1".equals(received.get(KEY + "/d/attrs")));
        assertThat(received).doesNotContainKey(KEY + "/e/attrs");
        leave(device);
    }

    /** Mosquitto does so too: the sender is not informed, but does not wait for an acknowledgment either. */
    @ParameterizedTest
    @ValueSource(ints = {1, 2})
    void acknowledgesAndDiscardsForbiddenMessages(int qos) throws MqttException {
        MqttClient device = connect(DEVICE);
        device.setTimeToWait(TIMEOUT_MS);
        device.publish(KEY + "/e/attrs", "forged".getBytes(UTF_8), qos, true);
        device.publish(KEY + "/d/attrs", "qos %d".formatted(qos).getBytes(UTF_8), qos, false);

        await().until(() -> "qos %d".formatted(qos).equals(received.get(KEY + "/d/attrs")));
        assertThat(received).doesNotContainKey(KEY + "/e/attrs");
        leave(device);
    }

    @Test
    void publishesNoWillToATopicOfAnotherDevice() throws MqttException {
        MqttClient device = new MqttClient(mqtt.uri().toString(), "forger", new MemoryPersistence());
        for (String topic : List.of("/e/attrs", "/d/attrs")) {
            MqttConnectOptions options = options(DEVICE);
            options.setWill(KEY + topic, "gone".getBytes(UTF_8), 1, false);
            device.connect(options);
            device.disconnectForcibly(0, TIMEOUT_MS, false);
        }

        await().until(() -> "gone".equals(received.get(KEY + "/d/attrs")));
        assertThat(received).doesNotContainKey(KEY + "/e/attrs");
        device.close();
    }

    @Test
    void closesTheConnectionOfAUserWhoseAccountIsRemoved() throws MqttException {
        MqttClient device = connect(DEVICE);
        MqttClient gateway = connect(SECRET.gateway("hoeing"));

        ACCOUNTS.replace(List.of(MqttAccount.gateway(SECRET, "hoeing")), Set.of());

        await().until(() -> !device.isConnected());
        assertThat(gateway.isConnected()).isTrue();
        leave(gateway);
        device.close();
    }

    @Test
    void allowsADeviceToReceiveOnlyItsOwnCommands() throws MqttException {
        MqttClient device = connect(DEVICE);
        Map<String, String> commands = new ConcurrentHashMap<>();
        assertThatThrownBy(() -> device.subscribe("#", 1)).isInstanceOf(MqttException.class);
        device.subscribe(
                KEY + "/d/cmd", 1, (topic, message) -> commands.put(topic, new String(message.getPayload(), UTF_8)));
        agent.publish(KEY + "/e/cmd", "on".getBytes(UTF_8), 1, false);
        agent.publish(KEY + "/d/cmd", "off".getBytes(UTF_8), 1, false);

        await().until(() -> "off".equals(commands.get(KEY + "/d/cmd")));
        assertThat(commands).containsOnlyKeys(KEY + "/d/cmd");
        leave(device);
    }

    @Test
    void rejectsADeviceThatIsNoLongerDesired() throws MqttException {
        leave(connect(DEVICE));
        ACCOUNTS.replace(List.of(), Set.of());

        assertThatThrownBy(() -> connect(DEVICE)).isInstanceOf(MqttException.class);
        assertThatThrownBy(() -> connect(new FarmSecret.Login("agent", "harrow")))
                .isInstanceOf(MqttException.class);
    }

    @Test
    void allowsAMissionWithTheNameOfAnInternalUser() throws MqttException {
        ACCOUNTS.replace(List.of(MqttAccount.gateway(SECRET, "agent")), Set.of());
        MqttClient gateway = connect(SECRET.gateway("agent"));

        assertThatThrownBy(() -> gateway.subscribe("#", 1)).isInstanceOf(MqttException.class);
        leave(gateway);
    }

    private static MqttClient connect(FarmSecret.Login login) throws MqttException {
        var client = new MqttClient(mqtt.uri().toString(), MqttClient.generateClientId(), new MemoryPersistence());
        try {
            client.connect(options(login));
            return client;
        } catch (MqttException e) {
            client.close();
            throw e;
        }
    }

    private static MqttConnectOptions options(FarmSecret.Login login) {
        MqttConnectOptions options = new MqttConnectOptions();
        options.setUserName(login.user());
        options.setPassword(login.password().toCharArray());
        return options;
    }

    private static void leave(MqttClient client) throws MqttException {
        client.disconnect();
        client.close();
    }
}
