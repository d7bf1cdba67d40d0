package io.furrow.provisioner;

import java.io.IOException;
import java.time.Instant;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Test;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.FarmSecret;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class SecretRotationTest extends ProvisioningFixture {

    @Test
    void acceptsOldAndNewPasswordsDuringARotationWithoutProvisioningAgain() throws Exception {
        Secret secret = new Secret();
        provisioning = provisioning(settings(secret, false), SAME_KAFKA);
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        provisioning.step();
        assertThat(provisioning.isSecretChanged()).isFalse();
        agent.changes.clear();
        Instant until = Instant.parse("2026-03-01T08:00:00Z");
        FarmSecret rotated = SECRET.rotated(until.minusSeconds(60), until, false);

        secret.current = rotated.at(until.minusSeconds(1));
        assertThat(provisioning.isSecretChanged()).isTrue();
        provisioning.step();
        assertThat(authenticates(SECRET.device("hoeing", device.device()))).isTrue();
        assertThat(authenticates(rotated.device("hoeing", device.device()))).isTrue();

        secret.current = rotated.at(until);
        assertThat(provisioning.isSecretChanged()).isTrue();
        provisioning.step();
        assertThat(authenticates(SECRET.device("hoeing", device.device()))).isFalse();
        assertThat(authenticates(rotated.device("hoeing", device.device()))).isTrue();
        assertThat(agent.changes).isEmpty();
        assertThat(counts).containsExactly(1, 2, 1);
    }

    @Test
    void replacesApiKeysOfAnOlderKeyAndRetainsForeignOnes() throws Exception {
        Secret secret = new Secret();
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        addDesired(DesiredDeviceFixture.thermometer("gone", 1));
        provisioning(settings(secret, false), SAME_KAFKA).step();
        agent.devices.put(
                "foreign",
                JsonNodeFactory.instance
                        .objectNode()
                        .put("device_id", "foreign")
                        .put("apikey", "secret"));
        desired.clear();
        addDesired(device);
        secret.current = SECRET.rotated(Instant.now(), Instant.EPOCH, true).at(Instant.now());

        assertThat(provisioning(settings(secret, false), SAME_KAFKA).step()).isEqualTo(DONE);

        assertThat(agent.deviceIds()).containsExactlyInAnyOrder(device.device(), "foreign");
        assertThat(agent.apiKeys()).containsExactly(secret.current.apiKey("hoeing"));
        assertThat(agent.devices.get(device.device()).path("apikey").asText())
                .isEqualTo(secret.current.apiKey("hoeing"));
        assertThat(authenticates(secret.current.device("hoeing", device.device())))
                .isTrue();
    }

    /** A stolen device must not wait for an agent. */
    @Test
    void rejectsAnOldPasswordWhileTheAgentIsUnavailable() throws Exception {
        DesiredDevice stolen = DesiredDeviceFixture.thermometer("hoeing", 1);
        DesiredDevice other = DesiredDeviceFixture.thermometer("hoeing", 2);
        addDesired(stolen);
        addDesired(other);
        provisioning.step();
        agent.unavailable = true;
        provisioning.refresh();
        addDesired(stolen.withGeneration(1));

        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("503");
        assertThat(authenticates(SECRET.device("hoeing", stolen.device()))).isFalse();
        assertThat(authenticates(SECRET.device("hoeing", other.device()))).isTrue();

        agent.unavailable = false;
        provisioning.step();
        assertThat(authenticates(SECRET.device("hoeing", stolen.device(), 1))).isTrue();
        assertThat(authenticates(SECRET.device("hoeing", stolen.device()))).isFalse();
        assertThat(authenticates(SECRET.device("hoeing", other.device()))).isTrue();
        assertThat(agent.changes)
                .filteredOn(change -> change.startsWith("DELETE"))
                .isEmpty();
    }

    @Test
    void changesNothingWithTheSecretOfAnotherFarm() throws Exception {
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        provisioning.step();
        agent.changes.clear();
        counts.clear();
        Secret another = new Secret();
        another.current = FarmSecret.generate();
        another.foreign = "this farm has another secret";
        provisioning = provisioning(settings(another, false), SAME_KAFKA);

        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessage(another.foreign);

        assertThat(agent.changes).isEmpty();
        assertThat(counts).isEmpty();
        assertThat(authenticates(SECRET.device("hoeing", "urn:ngsi-ld:Thermometer:hoeing-1")))
                .isTrue();
    }

    /** A secret that can be replaced, and marked as that of another farm. */
    private static final class Secret implements SecretSource {
        private FarmSecret current = SECRET;
        private String foreign;

        @Override
        public FarmSecret get() {
            return current;
        }

        @Override
        public void verify() throws IOException {
            if (foreign != null) {
                throw new IOException(foreign);
            }
        }
    }
}
