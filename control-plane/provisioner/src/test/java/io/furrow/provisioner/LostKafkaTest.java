package io.furrow.provisioner;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Instant;
import java.util.List;
import java.util.Properties;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;
import io.furrow.provisioner.ProvisioningReconciler.Outcome;
import io.furrow.provisioner.RemovalGuard.Origin;
import io.furrow.provisioner.account.MosquittoFiles;
import io.furrow.provisioner.account.MqttAccounts;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;

/** Provisions with a Kafka that is empty, or not the one for which devices were provisioned. */
class LostKafkaTest extends ProvisioningFixture {
    private static final Origin EMPTY = new Origin("topic-2", false);
    /** An agent may answer this while it starts. */
    private static final String EMPTY_ANSWER = "{'count':0,'devices':[],'services':[]}".replace('\'', '"');

    @TempDir
    Path directory;

    @Test
    void retainsAccountsAndDevicesOfAnotherKafka() throws Exception {
        provisionTen();

        provisioning = provisioning(files(false), new Origin("topic-2", true));
        Outcome outcome = provisioning.step();

        assertThat(users()).hasSize(10);
        assertThat(agent.deviceIds()).hasSize(10);
        assertThat(agent.apiKeys()).containsExactly(KEY);
        assertThat(outcome.done()).isTrue();
        assertThat(outcome.retained().text())
                .contains("10 MQTT accounts, 10 devices and 1 service groups of the IoT Agent stay")
                .contains("urn:ngsi-ld:Thermometer:hoeing-1", "Check --kafka", "--forget-devices");
        assertThat(outcome.retained().summary()).doesNotContain("hoeing");
    }

    @Test
    void retainsTheAgentsDevicesIfNoFileRecordsTheirKafka() throws Exception {
        provisionTen();

        provisioning = provisioning(settings(SecretSource.of(SECRET), false), EMPTY);
        assertThat(provisioning.step().retained().devices()).hasSize(10);
        assertThat(agent.deviceIds()).hasSize(10);

        provisioning = provisioning(settings(SecretSource.of(SECRET), false), SAME_KAFKA);
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.deviceIds()).isEmpty();
    }

    @Test
    void addsAndRemovesItsOwnDevicesBesidesRetainedOnes() throws Exception {
        provisionTen();
        provisioning = provisioning(files(false), EMPTY);
        DesiredDevice existing = DesiredDeviceFixture.thermometer("hoeing", 1);
        DesiredDevice fresh = DesiredDeviceFixture.thermometer("weeding", 1);

        addDesired(existing);
        addDesired(fresh);
        assertThat(provisioning.step().retained().devices()).hasSize(9);
        assertThat(users()).hasSize(11);
        assertThat(agent.deviceIds()).hasSize(11);

        addDesired(DesiredDeviceFixture.stopped(existing));
        addDesired(DesiredDeviceFixture.stopped(fresh));
        assertThat(provisioning.step().retained().devices()).hasSize(9);
        assertThat(users()).hasSize(9);
        assertThat(agent.deviceIds()).hasSize(9).doesNotContain(existing.device(), fresh.device());
        assertThat(agent.apiKeys()).containsExactly(KEY);
    }

    @Test
    void doesNotMoveADeviceOfAnotherKafkaToAnotherMission() throws Exception {
        String id = "d";
        DesiredDevice there = DesiredDeviceFixture.device("Thermometer", "hoeing", id, 1);
        addDesired(there);
        provisioning(files(false), SAME_KAFKA).step();
        DesiredDevice moved = DesiredDeviceFixture.device("Thermometer", "weeding", id, 1);
        desired.take(there.version().key(), null);
        addDesired(moved);
        provisioning = provisioning(files(false), EMPTY);

        for (int steps = 0; steps < 3; steps++) {
            Outcome outcome = provisioning.step();
            assertThat(outcome.rejected().get(moved.version().key()))
                    .contains("of mission 'hoeing'", "check --kafka", "--forget-devices");
            assertThat(outcome.retained().devices()).containsExactly(id);
            provisioning.refresh();
        }
        assertThat(agent.devices.get(id).path("apikey").asText()).isEqualTo(KEY);
    }

    @Test
    void removesAgainOnceItDesiresEverythingThatExists() throws Exception {
        provisionTen();
        addTenDesired();
        provisioning = provisioning(files(false), EMPTY);
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(Files.readString(passwords())).as("after one answer").doesNotContain("the topic topic-2");
        stepLater();
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(Files.readString(passwords())).contains("the topic topic-2").doesNotContain("topic-1");

        desired.clear();
        assertThat(provisioning(files(false), EMPTY).step()).isEqualTo(DONE);
        assertThat(users()).isEmpty();
        assertThat(agent.deviceIds()).isEmpty();
    }

    @Tag("full")
    @Test
    void retainsLoginsIfTheAgentReportsNoDevices() throws Exception {
        provisionTen();
        addTenDesired();
        agent.fixedAnswer = EMPTY_ANSWER;
        provisioning = provisioning(files(false), SAME_KAFKA);

        for (int answers = 0; answers < 3; answers++) {
            assertThat(provisioning.step().rejected()).hasSize(10);
            assertThat(users()).hasSize(10);
            stepLater();
        }
        agent.fixedAnswer = null;

        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(users()).hasSize(10);
        assertThat(agent.deviceIds()).hasSize(10);
    }

    @Test
    void doesNotTrustASingleEmptyAnswerOfTheAgent() throws Exception {
        provisionTen();
        addDesired(DesiredDeviceFixture.thermometer("weeding", 1));
        provisioning = provisioning(settings(SecretSource.of(SECRET), false), EMPTY);
        agent.fixedAnswer = EMPTY_ANSWER;
        assertThat(provisioning.step()).isEqualTo(DONE);

        agent.fixedAnswer = null;
        for (int answers = 0; answers < 3; answers++) {
            stepLater();
            assertThat(provisioning.step().retained().devices()).hasSize(10);
        }
        assertThat(agent.deviceIds()).hasSize(11);
    }

    @Test
    void removesRetainedDevicesIfConfigured() throws Exception {
        provisionTen();

        assertThat(provisioning(files(true), EMPTY).step()).isEqualTo(DONE);

        assertThat(users()).isEmpty();
        assertThat(agent.deviceIds()).isEmpty();
        assertThat(agent.apiKeys()).isEmpty();
    }

    /** The revoked login has generation 0, the current one generation 1. */
    @Test
    void doesNotAcceptARevokedLoginAgain() throws Exception {
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        provisioning = provisioning(files(false), SAME_KAFKA);
        provisioning.step();
        addDesired(device.withGeneration(1));
        provisioning.step();

        desired.clear();
        addDesired(device);
        provisioning = provisioning(files(false), EMPTY);
        assertThat(provisioning.step().rejected().get(device.version().key()))
                .contains("was revoked", "rotate the device's credentials 1 times");
        assertThat(users()).containsExactly(user(device, 1));

        addDesired(device.withGeneration(1));
        assertThat(provisioning.step()).isEqualTo(DONE);
        addDesired(DesiredDeviceFixture.stopped(device).withGeneration(1));
        provisioning.step();
        assertThat(users()).isEmpty();
        desired.clear();
        addDesired(device);
        assertThat(provisioning(files(true), new Origin("topic-3", false))
                        .step()
                        .rejected())
                .as("without a remaining account")
                .isNotEmpty();
        assertThat(users()).isEmpty();
    }

    @Test
    void removesOnlyAccountsWithAnExpiredKey() throws Exception {
        provisionTen();
        FarmSecret rotated = SECRET.rotated(Instant.now(), Instant.EPOCH, false).at(Instant.now());

        Outcome outcome =
                provisioning(files(SecretSource.of(rotated), false), EMPTY).step();

        assertThat(users()).isEmpty();
        assertThat(outcome.retained().devices()).hasSize(10);
    }

    /** Two farms may share a broker, and the keys of the other secret may have higher numbers. */
    @Test
    void retainsAccountsWhosePasswordIsNotOfItsSecret() throws Exception {
        provisionTen();
        FarmSecret another = FarmSecret.generate()
                .rotated(Instant.now(), Instant.EPOCH, false)
                .at(Instant.now());

        Outcome outcome =
                provisioning(files(SecretSource.of(another), false), EMPTY).step();

        assertThat(users()).hasSize(10);
        assertThat(outcome.retained().text()).contains("10 MQTT accounts");
    }

    /** The secret is from a copy that was made before the rotation. */
    @Test
    void retainsAccountsOfALaterKey() throws Exception {
        FarmSecret rotated = SECRET.rotated(Instant.now(), Instant.EPOCH, false).at(Instant.now());
        addTenDesired();
        provisioning = provisioning(files(SecretSource.of(rotated), false), SAME_KAFKA);
        provisioning.step();
        assertThat(users()).hasSize(10);
        desired.clear();

        provisioning = provisioning(files(false), EMPTY);
        provisioning.step();

        assertThat(users()).hasSize(10);
    }

    private static String user(DesiredDevice device, int generation) {
        return SECRET.device("hoeing", device.device(), generation).user();
    }

    private void addTenDesired() {
        for (int i = 1; i <= 10; i++) {
            addDesired(DesiredDeviceFixture.thermometer("hoeing", i));
        }
    }

    /** Provisions devices for another Kafka than {@link #EMPTY}; afterwards nothing is desired. */
    private void provisionTen() throws Exception {
        addTenDesired();
        provisioning = provisioning(files(false), SAME_KAFKA);
        assertThat(provisioning.step()).isEqualTo(DONE);
        stepLater();
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(users()).hasSize(10);
        desired.clear();
    }

    private ProvisioningSettings files(boolean forgets) {
        return files(SecretSource.of(SECRET), forgets);
    }

    private ProvisioningSettings files(SecretSource secret, boolean forgets) {
        List<MqttAccounts> files = List.of(new MosquittoFiles(passwords(), directory.resolve("rules"), null));
        return new ProvisioningSettings(
                new Properties(),
                DesiredDeviceFixture.SCOPE,
                secret,
                AgentSettings.at(agent.uri()),
                files,
                false,
                ConnectionSources.NONE,
                forgets);
    }

    private Path passwords() {
        return directory.resolve("passwords");
    }

    private List<String> users() throws IOException {
        return Files.readAllLines(passwords()).stream()
                .filter(line -> line.contains(":$7$"))
                .map(line -> line.substring(0, line.indexOf(':')))
                .toList();
    }
}
