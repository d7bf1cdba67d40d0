package io.furrow.provisioner;

import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.eclipse.paho.client.mqttv3.MqttException;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.clock.SettableClock;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.secret.SecretFile;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.kafka.secret.SecretTopic;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.FarmSecretCodec;
import io.furrow.model.topic.Topics;

import static io.furrow.provisioner.ProvisionedMosquitto.AGENT;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;
import static org.awaitility.Awaitility.await;

/** Rotates the farm's secret while devices are connected to a real Mosquitto and the provisioner is running. */
@Tag("full")
class RotationIT {
    private static final Duration ACCEPTED = Duration.ofDays(30);

    private final DesiredDevice first = DesiredDeviceFixture.thermometer("hoeing", 1);
    private final DesiredDevice second = DesiredDeviceFixture.thermometer("hoeing", 2);
    private final List<AutoCloseable> open = new ArrayList<>();
    private final SettableClock clock = new SettableClock(Instant.parse("2026-03-01T08:00:00Z"));
    private EmbeddedKafka kafka;
    private ProvisionedMosquitto broker;
    private FakeAgent iotAgent;
    private MqttPeer agent;
    private Path file;
    private SecretSource secret;
    private FarmSecret old;

    @BeforeEach
    void startWithTwoDevices(@TempDir Path directory) throws Exception {
        kafka = open(EmbeddedKafka.start(directory.resolve("kafka")));
        kafka.createTopics(Stream.of(Topics.DEVICES, Topics.DEVICES_STATUS, Topics.MISSION_DEVICES, Topics.SECRETS)
                .map(topic -> new NewTopic(topic, 1, (short) 1).configs(Map.of("cleanup.policy", "compact")))
                .toList());
        broker = open(new ProvisionedMosquitto(Files.createDirectory(directory.resolve("mosquitto"))));
        iotAgent = open(new FakeAgent());
        agent = open(broker.connect(AGENT, "agent").subscribe("#"));
        old = FarmSecret.generate();
        file = Files.writeString(directory.resolve("secret"), FarmSecretCodec.write(old));
        secret = SecretFile.open(file, new SecretTopic(kafka.client(), null), clock);
        open(Provisioner.start(new ProvisioningSettings(
                kafka.client(),
                DesiredDeviceFixture.SCOPE,
                secret,
                AgentSettings.at(iotAgent.uri()),
                List.of(broker.files()),
                false)));
        put(first, second);
    }

    @AfterEach
    void stop() throws Exception {
        for (int i = open.size() - 1; i >= 0; i--) {
            open.get(i).close();
        }
    }

    @Test
    void acceptsOldAndNewPasswordsUntilTheOldKeyExpires() throws Exception {
        MqttPeer moved = open(broker.connectOnceAccepted(old.device("hoeing", first.device())));
        MqttPeer late = open(broker.connectOnceAccepted(old.device("hoeing", second.device())));
        List<String> provisioning = List.copyOf(iotAgent.changes);
        String measures = "/" + old.apiKey("hoeing") + "/" + first.device() + "/attrs";

        FarmSecret rotated = rotate(old);

        MqttPeer renewed = open(broker.connectOnceAccepted(rotated.device("hoeing", first.device())));
        renewed.publish(measures, "new");
        await().until(() -> agent.newest(measures).equals("new"));
        moved.publish(measures, "old");
        await().until(() -> agent.newest(measures).equals("old"));
        open(broker.connect(old.device("hoeing", second.device()), "again"));
        assertThat(late.isConnected()).isTrue();

        clock.pass(ACCEPTED);

        await().until(() -> !late.isConnected() && !moved.isConnected());
        assertThatThrownBy(() -> broker.connect(old.device("hoeing", second.device()), "too-late"))
                .isInstanceOf(MqttException.class)
                .hasMessageContaining("Not authorized");
        broker.connect(rotated.device("hoeing", second.device()), "in-time").close();
        assertThat(renewed.isConnected()).isTrue();
        assertThat(agent.isConnected()).isTrue();
        assertThat(iotAgent.changes).isEqualTo(provisioning);
    }

    @Test
    void givesOneDeviceANewPasswordWithoutAffectingOthers() throws Exception {
        MqttPeer stolen = open(broker.connectOnceAccepted(old.device("hoeing", first.device())));
        MqttPeer other = open(broker.connectOnceAccepted(old.device("hoeing", second.device())));

        put(first.withGeneration(1));

        await().until(() -> !stolen.isConnected());
        broker.connectOnceAccepted(old.device("hoeing", first.device(), 1)).close();
        assertThatThrownBy(() -> broker.connect(old.device("hoeing", first.device()), "stolen"))
                .isInstanceOf(MqttException.class);
        assertThat(other.isConnected()).isTrue();
    }

    @Test
    void retainsTheSecretIfTheFileIsReplacedByThatOfAnotherFarm() throws Exception {
        MqttPeer device = open(broker.connectOnceAccepted(old.device("hoeing", first.device())));
        Files.writeString(file, FarmSecretCodec.write(FarmSecret.generate()));
        await().untilAsserted(() -> assertThat(secret.problem())
                .hasValueSatisfying(why -> assertThat(why).contains("this farm has another secret")));
        DesiredDevice third = DesiredDeviceFixture.thermometer("hoeing", 3);
        put(third);

        MqttPeer added = open(broker.connectOnceAccepted(old.device("hoeing", third.device())));

        assertThat(added.isConnected()).isTrue();
        assertThat(device.isConnected()).isTrue();
    }

    private FarmSecret rotate(FarmSecret secret) throws Exception {
        Instant now = clock.instant();
        FarmSecret rotated = secret.rotated(now, now.plus(ACCEPTED), false);
        Files.writeString(file, FarmSecretCodec.write(rotated));
        return rotated;
    }

    private void put(DesiredDevice... devices) {
        try (var producer = KafkaClients.producer(kafka.client())) {
            for (DesiredDevice device : devices) {
                producer.send(
                        new ProducerRecord<>(Topics.DEVICES, device.version().key(), device.toBytes()));
            }
        }
    }

    private <T extends AutoCloseable> T open(T part) {
        open.add(part);
        return part;
    }
}
