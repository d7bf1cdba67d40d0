package io.furrow.provisioner;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.file.AccessToken;
import io.furrow.provisioner.ProvisioningReconciler.Outcome;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** The resource of service groups. */
class AgentResourceTest {
    private static final Outcome DONE = new Outcome(Map.of(), null, null, true);
    private static final String API_KEY = DesiredDeviceFixture.SECRET.apiKey("hoeing");

    private final DesiredDeviceTable desired = new DesiredDeviceTable(DesiredDeviceFixture.SCOPE);
    private final DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);

    @AutoClose
    private FakeAgent agent;

    @BeforeEach
    void start() throws IOException {
        agent = new FakeAgent();
        desired.take(device.version().key(), device);
    }

    @ParameterizedTest
    @ValueSource(strings = {"", "/iot/json", "/iot/house"})
    void createsAndRemovesGroupsOfTheConfiguredResource(String resource) throws Exception {
        ProvisioningReconciler provisioning = provisioning(resource);

        assertThat(provisioning.step()).isEqualTo(DONE);
        JsonNode group = agent.groups.get(FakeAgent.key(resource, API_KEY));
        assertThat(group.path("resource").asText("none")).isEqualTo(resource);

        desired.take(device.version().key(), null);
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.groups).isEmpty();
    }

    @Test
    void replacesGroupsOfAPreviousResourceWithoutChangingDevices() throws Exception {
        provisioning("/iot/json").step();
        agent.changes.clear();

        assertThat(provisioning("").step()).isEqualTo(DONE);

        assertThat(agent.groups).containsOnlyKeys(FakeAgent.key("", API_KEY));
        assertThat(agent.changes).containsExactly("POST /iot/services", "DELETE /iot/services");
    }

    /** The agent has at most one group per resource and key over all tenants, but lists only those of the scope. */
    @Test
    void rejectsADeviceWhoseGroupIsInAnotherTenant() throws Exception {
        agent.hidden.put(FakeAgent.key("/iot/json", API_KEY), JsonNodeFactory.instance.objectNode());

        Outcome outcome = provisioning("/iot/json").step();

        assertThat(outcome.rejected().get(device.version().key()))
                .contains("mission 'hoeing'", "in another service or service path; remove it there");
        assertThat(agent.deviceIds()).isEmpty();
    }

    @Test
    void sendsTheTokenOfTheFileWithEachRequest(@TempDir Path directory) throws Exception {
        AccessToken token =
                AccessToken.of(Files.writeString(directory.resolve("token"), "s3cret\n"), "X-Farm", problem -> {});
        AgentSettings settings = AgentSettings.at(agent.uri()).withToken(token);

        assertThat(provisioning(settings).step()).isEqualTo(DONE);

        assertThat(agent.tokens).containsExactly("s3cret");
        assertThat(settings.toString()).doesNotContain("s3cret");
    }

    @Test
    void rejectsInvalidSettings() {
        AgentSettings settings = AgentSettings.at(URI.create("http://127.0.0.1:4041"));

        assertThatThrownBy(() -> settings.withResource("iot/json"))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContainingAll("must be empty or begin with '/'", "'iot/json'");
        assertThatThrownBy(() -> settings.withInterval(Duration.ZERO))
                .isInstanceOf(IllegalArgumentException.class)
                .hasMessageContaining("at least a second");
        assertThat(settings.interval()).isLessThanOrEqualTo(Duration.ofSeconds(30));
    }

    private ProvisioningReconciler provisioning(String resource) {
        return provisioning(AgentSettings.at(agent.uri()).withResource(resource));
    }

    private ProvisioningReconciler provisioning(AgentSettings settings) {
        return new ProvisioningReconciler(
                new ProvisioningSettings(
                        new Properties(), DesiredDeviceFixture.SCOPE, DesiredDeviceFixture.SECRET, settings, List.of()),
                desired,
                System::nanoTime);
    }
}
