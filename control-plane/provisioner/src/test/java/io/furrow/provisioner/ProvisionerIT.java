package io.furrow.provisioner;

import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.Optional;

import org.apache.kafka.clients.admin.Admin;
import org.apache.kafka.clients.admin.NewTopic;
import org.apache.kafka.clients.consumer.ConsumerRecord;
import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.embedded.EmbeddedKafka;
import io.furrow.kafka.CommittedReader;
import io.furrow.kafka.KafkaClients;
import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.control.Fault;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceStatus;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.account.InMemoryAccounts;

import static io.furrow.provisioner.DesiredDeviceFixture.thermometer;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class ProvisionerIT {
    @TempDir
    Path directory;

    private final InMemoryAccounts accounts = new InMemoryAccounts();
    private EmbeddedKafka kafka;
    private FakeAgent agent;
    private KafkaProducer<String, byte[]> producer;

    @BeforeEach
    void start() throws Exception {
        kafka = EmbeddedKafka.start(directory.resolve("kafka"));
        agent = new FakeAgent();
        producer = KafkaClients.producer(kafka.client());
        createTopics();
    }

    @AfterEach
    void stop() {
        producer.close();
        agent.close();
        kafka.close();
    }

    @Test
    void followsTheTopicAndRemovesDevicesThatWereDeletedBeforeARestart() throws Exception {
        DesiredDevice one = thermometer("hoeing", 1);
        DesiredDevice two = thermometer("hoeing", 2);
        try (Provisioner provisioner = provisioner()) {
            put(one);
            put(two);
            await().until(() -> agent.deviceIds().size() == 2);
            awaitThatRemovalIsAllowed();
            assertThat(provisioner).isNotNull();
        }
        producer.send(new ProducerRecord<>(Topics.DEVICES, one.version().key(), null));
        try (Provisioner provisioner = provisioner()) {
            await().until(() -> agent.deviceIds().size() == 1);
            assertThat(agent.deviceIds()).containsExactly(two.device());
            put(DesiredDeviceFixture.stopped(two));
            await().until(() -> agent.apiKeys().isEmpty());
            assertThat(agent.deviceIds()).isEmpty();
            assertThat(provisioner).isNotNull();
        }
        assertThat(agent.changes)
                .filteredOn(change -> change.equals("POST /iot/services"))
                .hasSize(1);
        assertThat(statuses()).isEmpty();
    }

    @Test
    void reportsWhyADeviceIsNotProvisionedAndRetries() throws Exception {
        DesiredDevice before = thermometer("hoeing", 1);
        DesiredDevice after = thermometer("hoeing", 2);
        DesiredDevice rejected = thermometer("hoeing", 3);
        agent.rejectedIds.add(rejected.device());
        try (Provisioner provisioner = provisioner()) {
            put(before);
            put(rejected);
            await().until(() -> statuses().containsKey(rejected.version().key()));
            agent.unavailable = true;
            put(after);
            await().until(() -> statuses().containsKey(after.version().key()));

            assertThat(statuses()).doesNotContainKey(before.version().key());
            assertThat(statuses().get(rejected.version().key()).reason()).contains("not provisioned", "422");
            DeviceStatus status = statuses().get(after.version().key());
            assertThat(status.state()).isEqualTo(DeviceStatus.State.FAILED);
            assertThat(status.sequence()).isEqualTo(after.version().sequence());
            assertThat(status.reason()).contains("not provisioned", "answers 503");

            agent.rejectedIds.clear();
            agent.unavailable = false;
            await().until(() -> agent.deviceIds().size() == 3);
            assertThat(provisioner).isNotNull();
        }
    }

    @Test
    void restoresLostRegistrationsAtTheNextInterval() throws Exception {
        put(thermometer("hoeing", 1));
        put(thermometer("hoeing", 2));
        try (Provisioner provisioner = provisioner()) {
            await().until(() -> agent.deviceIds().size() == 2);

            agent.restart();

            await().until(() -> agent.deviceIds().size() == 2);
            assertThat(agent.apiKeys()).containsExactly(DesiredDeviceFixture.SECRET.apiKey("hoeing"));
            assertThat(provisioner).isNotNull();
        }
        assertThat(statuses()).isEmpty();
    }

    /** A Kafka without these devices reports them as retained until it is started with the option to forget them. */
    @Test
    void retainsDevicesOfAnotherKafka() throws Exception {
        put(thermometer("hoeing", 1));
        try (Provisioner provisioner = provisioner()) {
            await().until(() -> agent.deviceIds().size() == 1);
            assertThat(provisioner).isNotNull();
        }
        kafka.close();
        kafka = EmbeddedKafka.start(directory.resolve("another"));
        createTopics();
        int changes = agent.changes.size();
        try (Provisioner provisioner = provisioner();
                CommittedReader<String> faults = CommittedReader.open(kafka.client(), Topics.FAULTS)) {
            List<ConsumerRecord<String, byte[]>> records = new ArrayList<>();
            await().until(() -> {
                faults.poll(Duration.ofMillis(100)).forEach(records::add);
                return !records.isEmpty();
            });
            assertThat(Fault.read(records.get(0).value()).text())
                    .contains("1 devices", "Thermometer:hoeing-1", "--forget-devices");
            assertThat(provisioner.status().detail()).contains("1 devices").doesNotContain("hoeing");
        }
        assertThat(agent.changes).hasSize(changes);

        try (Provisioner provisioner = Provisioner.start(settings(true))) {
            await().until(() -> agent.apiKeys().isEmpty());
            assertThat(agent.deviceIds()).isEmpty();
            assertThat(provisioner).isNotNull();
        }
    }

    @Test
    void letsTheOtherOfTwoInstancesTakeOver() {
        Provisioner first = provisioner();
        put(thermometer("hoeing", 1));
        await().until(() -> agent.deviceIds().size() == 1);
        try (Provisioner second = provisioner()) {
            put(thermometer("hoeing", 2));
            await().until(() -> agent.deviceIds().size() == 2);
            first.close();
            put(thermometer("weeding", 1));
            await().until(() -> agent.deviceIds().size() == 3);
            assertThat(second).isNotNull();
        } finally {
            first.close();
        }
        assertThat(agent.changes)
                .filteredOn(change -> change.equals("POST /iot/devices"))
                .hasSize(3);
    }

    /** A committed offset records that the devices of this Kafka were provisioned at the agent. */
    private void awaitThatRemovalIsAllowed() {
        try (Admin admin = Admin.create(kafka.client())) {
            await().until(() -> !admin.listConsumerGroupOffsets(ProvisioningWorker.GROUP)
                    .partitionsToOffsetAndMetadata()
                    .get()
                    .isEmpty());
        }
    }

    private Provisioner provisioner() {
        return Provisioner.start(settings(false));
    }

    private ProvisioningSettings settings(boolean forgets) {
        return new ProvisioningSettings(
                kafka.client(),
                DesiredDeviceFixture.SCOPE,
                SecretSource.of(DesiredDeviceFixture.SECRET),
                AgentSettings.at(agent.uri()).withInterval(Duration.ofSeconds(1)),
                List.of(accounts),
                false,
                ConnectionSources.NONE,
                forgets);
    }

    private void createTopics() {
        kafka.createTopics(List.of(
                topic(Topics.DEVICES),
                topic(Topics.DEVICES_STATUS),
                topic(Topics.MISSION_DEVICES),
                topic(Topics.FAULTS)));
    }

    private void put(DesiredDevice device) {
        producer.send(new ProducerRecord<>(Topics.DEVICES, device.version().key(), device.toBytes()));
        producer.flush();
    }

    private Map<String, DeviceStatus> statuses() throws Exception {
        Map<String, DeviceStatus> statuses = new HashMap<>();
        try (CommittedReader<String> reader = CommittedReader.open(kafka.client(), Topics.DEVICES_STATUS)) {
            reader.readToEnd(record -> statuses.put(record.key(), DeviceStatus.read(record.value())));
        }
        return statuses;
    }

    private static NewTopic topic(String name) {
        return new NewTopic(name, Optional.of(1), Optional.empty()).configs(Map.of("cleanup.policy", "compact"));
    }
}
