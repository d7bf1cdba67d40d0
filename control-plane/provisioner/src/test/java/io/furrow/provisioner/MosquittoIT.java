package io.furrow.provisioner;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.Set;

import org.eclipse.paho.client.mqttv3.MqttException;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecret.Login;
import io.furrow.provisioner.account.MosquittoFiles;
import io.furrow.provisioner.account.MosquittoPassword;
import io.furrow.provisioner.account.MqttAccount;

import static io.furrow.provisioner.ProvisionedMosquitto.AGENT;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** Uses the written files in a real Mosquitto that reloads them while it runs. */
class MosquittoIT {
    private static final FarmSecret SECRET = DesiredDeviceFixture.SECRET;
    private static final String KEY = "/" + SECRET.apiKey("hoeing");
    private static final String OTHER_KEY = "/" + SECRET.apiKey("weeding");
    /** The name contains characters with a meaning in the files. */
    private static final String DEVICE = "urn:ngsi-ld:Thermometer:hoeing-1";

    private static final List<MqttAccount> ACCOUNTS = List.of(
            MqttAccount.gateway(SECRET, "hoeing"),
            MqttAccount.device(SECRET, "hoeing", DEVICE),
            MqttAccount.device(SECRET, "weeding", "other"));

    @AutoClose
    private ProvisionedMosquitto broker;

    private MosquittoFiles files;

    @AutoClose
    private MqttPeer agent;

    @BeforeEach
    void startWithTheAgentAsItsOnlyUser(@TempDir Path directory) throws Exception {
        broker = start(directory);
        files = broker.files();
        agent = broker.connect(AGENT, "agent").subscribe("#");
        files.replace(ACCOUNTS, Set.of());
    }

    ProvisionedMosquitto start(Path folder) throws Exception {
        return new ProvisionedMosquitto(folder);
    }

    @Test
    void acceptsADeviceOnlyWithItsPassword() throws Exception {
        Login right = SECRET.device("hoeing", DEVICE);
        try (MqttPeer device = broker.connectOnceAccepted(right)) {
            device.publish(KEY + "/" + DEVICE + "/attrs", "1");
            await().until(() -> agent.newest(KEY + "/" + DEVICE + "/attrs").equals("1"));
        }
        Login guessed = new Login(right.user(), SECRET.device("hoeing", "d").password());
        assertThatThrownBy(() -> broker.connect(guessed, "guess"))
                .isInstanceOf(MqttException.class)
                .hasMessageContaining("Not authorized");
    }

    @Test
    void allowsADeviceToPublishOnlyAsItself() throws Exception {
        try (MqttPeer device = broker.connectOnceAccepted(SECRET.device("hoeing", DEVICE))) {
            List<String> foreign = List.of(
                    KEY + "/urn:ngsi-ld:Thermometer:hoeing-2/attrs",
                    OTHER_KEY + "/" + DEVICE + "/attrs",
                    "/json" + OTHER_KEY + "/other/attrs",
                    KEY + "/" + DEVICE + "/cmd");
            for (String topic : foreign) {
                device.publish(topic, "forged");
            }
            device.publish("/json" + KEY + "/" + DEVICE + "/attrs", "2");

            // A connection preserves the order, so a forged message would have arrived before.
            await().until(() ->
                    agent.newest("/json" + KEY + "/" + DEVICE + "/attrs").equals("2"));
            assertThat(foreign)
                    .allSatisfy(topic -> assertThat(agent.newest(topic)).isEmpty());
        }
    }

    @Test
    void allowsADeviceToReceiveOnlyItsOwnCommands() throws Exception {
        try (MqttPeer device = broker.connectOnceAccepted(SECRET.device("hoeing", DEVICE))) {
            device.subscribe("#");
            device.subscribe(KEY + "/" + DEVICE + "/cmd");
            agent.publish(KEY + "/urn:ngsi-ld:Thermometer:hoeing-2/cmd", "on");
            agent.publish(KEY + "/" + DEVICE + "/attrs", "3");
            agent.publish(KEY + "/" + DEVICE + "/cmd", "off");

            await().until(() -> device.newest(KEY + "/" + DEVICE + "/cmd").equals("off"));
            assertThat(device.topics()).containsOnly(KEY + "/" + DEVICE + "/cmd");
        }
    }

    @Test
    void allowsAGatewayToPublishOnlyForItsMission() throws Exception {
        try (MqttPeer gateway = broker.connectOnceAccepted(SECRET.gateway("hoeing"))) {
            gateway.publish(OTHER_KEY + "/other/attrs", "forged");
            gateway.publish(KEY + "/any/attrs", "4");
            gateway.subscribe(KEY + "/+/cmd");
            agent.publish(KEY + "/any/cmd", "on");

            await().until(() -> agent.newest(KEY + "/any/attrs").equals("4"));
            await().until(() -> gateway.newest(KEY + "/any/cmd").equals("on"));
            assertThat(agent.newest(OTHER_KEY + "/other/attrs")).isEmpty();
        }
    }

    @Test
    void rejectsADeviceThatIsNoLongerDesiredAndRetainsTheAgent() throws Exception {
        try (MqttPeer device = broker.connectOnceAccepted(SECRET.device("hoeing", DEVICE))) {
            files.replace(List.of(), Set.of());

            await().until(() -> !device.isConnected());
            assertThatThrownBy(() -> broker.connect(SECRET.device("hoeing", DEVICE), "again"))
                    .isInstanceOf(MqttException.class);
            assertThat(agent.isConnected()).isTrue();
        }
    }

    @Tag("full")
    @Test
    void allowsAMissionWithTheNameOfAnotherUser() throws Exception {
        String key = "/" + SECRET.apiKey("agent");
        files.replace(List.of(MqttAccount.gateway(SECRET, "agent")), Set.of());

        try (MqttPeer gateway = broker.connectOnceAccepted(SECRET.gateway("agent"));
                MqttPeer again = broker.connect(AGENT, "agent-again").subscribe("#")) {
            gateway.publish(KEY + "/" + DEVICE + "/attrs", "forged");
            gateway.publish(key + "/d/attrs", "5");

            await().until(() -> again.newest(key + "/d/attrs").equals("5"));
            assertThat(again.newest(KEY + "/" + DEVICE + "/attrs")).isEmpty();
            assertThat(agent.isConnected()).isTrue();
        }
    }

    @Tag("full")
    @Test
    void doesNotReplaceAForeignUser() throws Exception {
        Login foreign = new Login(SECRET.device("hoeing", "theirs").user(), "their password");
        List<String> lines = new ArrayList<>(Files.readAllLines(broker.passwords()));
        lines.add(0, MosquittoPassword.line(foreign));
        Files.write(broker.passwords(), lines);
        List<MqttAccount> desired = new ArrayList<>(ACCOUNTS);
        desired.add(MqttAccount.device(SECRET, "hoeing", "theirs"));
        desired.add(MqttAccount.device(SECRET, "hoeing", "late"));

        assertThat(files.replace(desired, Set.of())).containsOnlyKeys(foreign.user());

        broker.connectOnceAccepted(SECRET.device("hoeing", "late")).close();
        broker.connect(foreign, "foreign").close();
        assertThatThrownBy(() -> broker.connect(SECRET.device("hoeing", "theirs"), "ours"))
                .isInstanceOf(MqttException.class);
    }

    /** An open connection with the old password is closed, others are not. */
    @Test
    void rejectsTheOldPasswordAfterARotationAndClosesItsConnection() throws Exception {
        List<MqttAccount> rotated = new ArrayList<>(MqttAccount.devices(SECRET, "hoeing", DEVICE, 1));
        rotated.add(MqttAccount.device(SECRET, "weeding", "other"));
        try (MqttPeer stolen = broker.connectOnceAccepted(SECRET.device("hoeing", DEVICE));
                MqttPeer other = broker.connect(SECRET.device("weeding", "other"), "other")) {
            files.retain(
                    Set.of(
                            SECRET.device("hoeing", DEVICE, 1).user(),
                            SECRET.device("weeding", "other").user()),
                    (user, login) -> true);
            await().until(() -> !stolen.isConnected());
            files.replace(rotated, Set.of());

            broker.connectOnceAccepted(SECRET.device("hoeing", DEVICE, 1)).close();
            assertThatThrownBy(() -> broker.connect(SECRET.device("hoeing", DEVICE), "again"))
                    .isInstanceOf(MqttException.class);
            assertThat(other.isConnected()).isTrue();
            assertThat(agent.isConnected()).isTrue();
        }
    }
}
