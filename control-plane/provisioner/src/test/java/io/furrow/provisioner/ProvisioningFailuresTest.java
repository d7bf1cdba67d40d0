package io.furrow.provisioner;

import java.io.IOException;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.Timeout;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.provisioner.ProvisioningReconciler.Outcome;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

/** Provisions at an IoT Agent that loses state, rejects, fails or is slow. */
@Tag("full")
class ProvisioningFailuresTest extends ProvisioningFixture {
    private static final String GROUP = FakeAgent.key("/iot/json", KEY);

    @ParameterizedTest
    @ValueSource(strings = {"all", "groups", "devices", "a device"})
    void restoresLostRegistrations(String lost) throws Exception {
        addDesired(3);
        provisioning.step();
        switch (lost) {
            case "all" -> agent.restart();
            case "groups" -> agent.groups.clear();
            case "devices" -> agent.devices.clear();
            default -> agent.devices.remove(id(2));
        }
        agent.changes.clear();

        provisioning.refresh();
        assertThat(provisioning.step()).isEqualTo(DONE);

        assertThat(agent.deviceIds()).containsExactlyInAnyOrder(id(1), id(2), id(3));
        assertThat(agent.groups).containsOnlyKeys(GROUP);
        assertThat(agent.changes).hasSize(lost.equals("all") ? 2 : 1);
    }

    @Test
    void acceptsADeviceThatTheAgentCreatedAfterItRejectedTheBatch() throws Exception {
        addDesired(4);
        agent.rejectedIds.add(id(1));
        agent.createdLate.add(id(2));
        agent.createdLate.add(id(3));

        assertThat(provisioning.step().rejected()).containsOnlyKeys(key(1));

        assertThat(agent.deviceIds()).containsExactlyInAnyOrder(id(2), id(3), id(4));
    }

    @Test
    void provisionsTheOthersIfTheAgentFailsOnOneDevice() throws Exception {
        addDesired(3);
        agent.broken.add(id(1));

        Outcome outcome = provisioning.step();

        assertThat(outcome.done()).isTrue();
        assertThat(outcome.rejected()).containsOnlyKeys(key(1));
        assertThat(outcome.rejected().get(key(1))).contains("500", "cannot make");
        assertThat(agent.deviceIds()).containsExactlyInAnyOrder(id(2), id(3));

        agent.broken.clear();
        provisioning.refresh();
        assertThat(provisioning.step()).isEqualTo(DONE);
    }

    @ParameterizedTest
    @ValueSource(ints = {400, 401, 403, 404, 407, 451})
    void doesNotRejectADeviceBecauseOfAProxysAnswer(int status) throws Exception {
        addDesired(1);
        agent.proxy = status;
        assertThatThrownBy(provisioning::step)
                .isInstanceOf(IOException.class)
                .hasMessageContaining(Integer.toString(status));

        agent.proxy = 0;
        assertThat(provisioning.step().rejected()).isEmpty();
        assertThat(agent.devices).containsKey(id(1));
    }

    @Test
    void doesNotTakeADeviceForRemovedBecauseOfAProxysAnswer() throws Exception {
        DesiredDevice device = addDesired(1).get(0);
        provisioning.step();
        desired.take(device.version().key(), null);
        agent.proxy = 404;
        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("404");
        assertThat(agent.devices).containsKey(id(1));

        agent.proxy = 0;
        provisioning.step();
        assertThat(agent.devices).isEmpty();
    }

    @Test
    void treatsAnAgentThatFailsOnAllDevicesAsUnavailable() {
        addDesired(3);
        agent.broken.addAll(List.of(id(1), id(2), id(3)));

        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("500");
    }

    @Test
    void provisionsALargeMissionAtASlowAgent() throws Exception {
        clock = elapsed::get; // no step ends early on a busy machine
        provisioning = provisioning();
        addDesired(60);
        agent.maxBatch = 4;
        int failures = 0;
        int inARow = 0;
        for (int step = 0; step < 100 && agent.deviceIds().size() < 60; step++) {
            try {
                provisioning.step();
                inARow = 0;
            } catch (IOException e) {
                failures++;
                inARow++;
                provisioning.refresh();
            }
            assertThat(inARow).as("failures in a row").isLessThan(FailureReporter.ATTEMPTS);
        }

        assertThat(agent.deviceIds()).hasSize(60);
        assertThat(failures).isPositive();
    }

    @Test
    void removesTheOthersIfTheAgentFailsOnOneDevice() throws Exception {
        List<DesiredDevice> devices = addDesired(3);
        provisioning.step();
        devices.forEach(device -> desired.take(device.version().key(), null));
        agent.broken.add(id(1));

        Outcome outcome = provisioning.step();

        assertThat(outcome.done()).isTrue();
        assertThat(outcome.removalFailure()).contains("500", "cannot remove");
        assertThat(agent.deviceIds()).containsExactly(id(1));
        assertThat(agent.groups).containsOnlyKeys(GROUP);

        agent.broken.clear();
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.groups).isEmpty();
    }

    /** Advances the time by three seconds in each request. */
    @Test
    void removesManyDevicesOfASlowAgentInShortSteps() throws Exception {
        clock = elapsed::get;
        provisioning = provisioning();
        List<DesiredDevice> devices = addDesired(100);
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(100);
        }
        devices.forEach(device -> desired.take(device.version().key(), null));
        agent.onChange = () -> elapsed.addAndGet(Duration.ofSeconds(3).toNanos());

        int steps = 0;
        boolean done = false;
        while (!done) {
            long before = elapsed.get();
            done = provisioning.step().done();
            steps++;
            assertThat(Duration.ofNanos(elapsed.get() - before))
                    .isLessThanOrEqualTo(ProvisioningReconciler.STEP.plusSeconds(3));
        }

        assertThat(steps).isBetween(20, 101);
        assertThat(agent.deviceIds()).isEmpty();
        assertThat(agent.groups).isEmpty();
    }

    @ParameterizedTest
    @ValueSource(strings = {"<html>not an agent</html>", "{}", "{\"count\": 1, \"devices\": {}}", "[]"})
    void changesNothingWhileTheAgentsAnswersAreUnreadable(String answer) throws Exception {
        addDesired(2);
        provisioning.step();
        desired.take(key(1), null);
        agent.changes.clear();
        agent.fixedAnswer = answer;

        provisioning.refresh();
        assertThatThrownBy(provisioning::step)
                .isInstanceOf(IOException.class)
                .hasMessageContainingAll("/iot/devices", "is it an IoT Agent?");

        assertThat(agent.changes).isEmpty();
    }

    @Test
    @Timeout(value = 60, threadMode = Timeout.ThreadMode.SEPARATE_THREAD)
    void readsAFullPageOfGroups() throws Exception {
        for (int i = 0; i < 500; i++) {
            agent.groups.put(
                    FakeAgent.key("/iot/json", "k" + i),
                    JsonNodeFactory.instance.objectNode().put("apikey", "k" + i).put("resource", "/iot/json"));
        }
        addDesired(1);

        assertThat(provisioning.step()).isEqualTo(DONE);
    }

    @Test
    void rejectsOnlyDevicesOfTheDefaultTenant() throws Exception {
        addDesired(1);
        DesiredDevice device = DesiredDeviceFixture.thermometer("old", 1);
        DeviceVersion of = device.version();
        var version = new DeviceVersion(of.id(), "", "/", of.domain(), of.mission(), 0, null, of.sequence(), null);
        desired.take(
                version.key(),
                DesiredDevice.simulated(
                        version, device.type(), device.device(), true, device.period(), device.settings()));

        Outcome outcome = provisioning.step();

        assertThat(outcome.done()).isTrue();
        assertThat(outcome.rejected()).containsOnlyKeys(version.key());
        assertThat(outcome.rejected().get(version.key())).contains("needs a tenant", "--fiware-service");
        assertThat(agent.deviceIds()).containsExactly(id(1));
        assertThat(agent.services).containsExactly("farm");
    }

    private static String id(int number) {
        return "urn:ngsi-ld:Thermometer:hoeing-" + number;
    }

    private static String key(int number) {
        return DesiredDeviceFixture.SCOPE.identity(id(number));
    }

    private List<DesiredDevice> addDesired(int count) {
        List<DesiredDevice> devices = new ArrayList<>();
        for (int i = 1; i <= count; i++) {
            DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", i);
            devices.add(device);
            addDesired(device);
        }
        return devices;
    }
}
