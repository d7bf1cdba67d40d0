package io.furrow.provisioner;

import java.io.IOException;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.kafka.secret.SecretSource;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.GroupRef;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.provisioner.ProvisioningReconciler.Outcome;

import static io.furrow.provisioner.DesiredDeviceFixture.SECRET;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

@Tag("full")
class ProvisioningReconcilerTest extends ProvisioningFixture {

    @Test
    void provisionsDevicesWithTheKeyAndNameOfTheirMission() throws Exception {
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        addDesired(DesiredDeviceFixture.device("WeatherStation", "hoeing", "station", 1));

        assertThat(provisioning.step()).isEqualTo(DONE);

        assertThat(agent.apiKeys()).containsExactly(KEY);
        assertThat(agent.groups
                        .get(FakeAgent.key("/iot/json", KEY))
                        .path("autoprovision")
                        .asBoolean(true))
                .isFalse();
        JsonNode thermometer = agent.devices.get("urn:ngsi-ld:Thermometer:hoeing-1");
        assertThat(thermometer.path("apikey").asText()).isEqualTo(KEY);
        assertThat(thermometer.path("entity_name").asText()).isEqualTo("urn:ngsi-ld:Thermometer:hoeing-1");
        assertThat(thermometer.path("entity_type").asText()).isEqualTo("Thermometer");
        assertThat(thermometer.path("attributes").findValuesAsText("object_id"))
                .containsExactly("temp", "stat", "time", "lat", "lon", "where", "bat");
        assertThat(thermometer.path("static_attributes").findValuesAsText("value"))
                .containsExactly("north", "hoeing");
        assertThat(thermometer.path("commands").findValuesAsText("name")).containsExactly("on", "off", "restart");
        assertThat(agent.devices.get("station").path("attributes").findValuesAsText("name"))
                .contains("Humidity", "Rain", "battery");
    }

    @Test
    void skipsSimulatedRobotsAndDevicesListedByIdOnly() throws Exception {
        addDesired(DesiredDeviceFixture.device("Robot", "hoeing", "robot", 1));
        addDesired(DesiredDevice.simulated(
                DesiredDeviceFixture.thermometer("hoeing", 1).version(),
                null,
                null,
                true,
                null,
                JsonNodeFactory.instance.objectNode()));

        assertThat(provisioning.step()).isEqualTo(DONE);

        assertThat(agent.changes).isEmpty();
        assertThat(counts).containsExactly(0);
    }

    @Test
    void grantsEachDeviceAnAccountOnceTheAgentHasIt() throws Exception {
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 2));
        agent.unavailable = true;
        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("503");
        assertThat(counts).isEmpty();

        agent.unavailable = false;
        provisioning.step();

        assertThat(counts).containsExactly(2);
        String device = "urn:ngsi-ld:Thermometer:hoeing-1";
        var login = SECRET.device("hoeing", device);
        assertThat(accounts.authenticates(login.user(), login.password().getBytes()))
                .isTrue();
        assertThat(accounts.mayWrite(login.user(), "/" + KEY + "/" + device + "/attrs"))
                .isTrue();
    }

    @Test
    void grantsGatewayAccountsOnlyIfConfigured() throws Exception {
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        String gateway = SECRET.gateway("hoeing").user();
        provisioning.step();
        assertThat(accounts.mayRead(gateway, "/" + KEY + "/+/cmd")).isFalse();

        provisioning = provisioning(settings(SecretSource.of(SECRET), true), SAME_KAFKA);
        provisioning.step();

        assertThat(counts).containsExactly(1, 2);
        assertThat(accounts.mayRead(gateway, "/json/" + KEY + "/+/cmd")).isTrue();
    }

    @Test
    void removesStoppedAndDeletedDevices() throws Exception {
        DesiredDevice first = DesiredDeviceFixture.thermometer("hoeing", 1);
        DesiredDevice second = DesiredDeviceFixture.thermometer("weeding", 1);
        addDesired(first);
        addDesired(second);
        provisioning.step();

        addDesired(DesiredDeviceFixture.stopped(first));
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.deviceIds()).containsExactly(second.device());
        assertThat(agent.apiKeys()).containsExactly(SECRET.apiKey("weeding"));
        assertThat(accounts.mayRead(
                        SECRET.device("hoeing", first.device()).user(), "/" + KEY + "/" + first.device() + "/cmd"))
                .isFalse();

        desired.take(second.version().key(), null);
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.deviceIds()).isEmpty();
        assertThat(agent.apiKeys()).isEmpty();
        assertThat(counts).containsExactly(2, 1, 0);
    }

    @Test
    void removesOnlyItsOwnLeftoversAfterARestart() throws Exception {
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        addDesired(DesiredDeviceFixture.thermometer("gone", 1));
        provisioning.step();
        ObjectNode foreign = JsonNodeFactory.instance
                .objectNode()
                .put("device_id", "foreign")
                .put("apikey", "secret");
        agent.devices.put("foreign", foreign);
        agent.changes.clear();

        desired.clear();
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 1));
        assertThat(provisioning().step()).isEqualTo(DONE);

        assertThat(agent.changes)
                .containsExactly("DELETE /iot/devices/urn:ngsi-ld:Thermometer:gone-1", "DELETE /iot/services");
        assertThat(agent.deviceIds()).containsExactlyInAnyOrder("foreign", "urn:ngsi-ld:Thermometer:hoeing-1");
    }

    @Test
    void replacesRegistrationsThatDiffer() throws Exception {
        addDesired(DesiredDeviceFixture.device("Thermometer", "hoeing", "d", 1));
        provisioning.step();
        addDesired(DesiredDeviceFixture.device("Camera", "hoeing", "d", 2));

        assertThat(provisioning.step()).isEqualTo(DONE);

        assertThat(agent.devices.get("d").path("entity_type").asText()).isEqualTo("Camera");
    }

    @Test
    void rejectsAForeignDevice() throws Exception {
        agent.devices.put(
                "d", JsonNodeFactory.instance.objectNode().put("device_id", "d").put("apikey", "secret"));
        DesiredDevice device = DesiredDeviceFixture.device("Thermometer", "hoeing", "d", 1);
        addDesired(device);

        assertThat(provisioning.step().rejected().get(device.version().key()))
                .contains("somebody else has provisioned");
        assertThat(agent.devices.get("d").path("apikey").asText()).isEqualTo("secret");
    }

    @Test
    void createsTheOthersOfABatchIfTheAgentRejectsSome() throws Exception {
        for (int i = 1; i <= 250; i++) {
            addDesired(DesiredDeviceFixture.thermometer("hoeing", i));
            if (i <= 120) {
                agent.rejectedIds.add("urn:ngsi-ld:Thermometer:hoeing-" + i);
            }
        }

        Outcome outcome = provisioning.step();
        for (int steps = 0; !outcome.done() && steps < 10; steps++) {
            outcome = provisioning.step();
        }

        assertThat(outcome.done()).isTrue();
        assertThat(outcome.rejected())
                .hasSize(120)
                .allSatisfy((key, reason) -> assertThat(reason).contains("422", "not urn"));
        assertThat(agent.deviceIds()).hasSize(130);
        assertThat(counts.get(counts.size() - 1)).isEqualTo(130);

        agent.rejectedIds.clear();
        provisioning.refresh();
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }
        assertThat(agent.deviceIds()).hasSize(250);
    }

    @Test
    void retainsAccountsWhileLostRegistrationsAreRestored() throws Exception {
        for (int i = 1; i <= 250; i++) {
            addDesired(DesiredDeviceFixture.thermometer("hoeing", i));
        }
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }
        agent.restart();
        counts.clear();

        provisioning.refresh();
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }

        assertThat(agent.deviceIds()).hasSize(250);
        assertThat(counts).isEmpty();
    }

    @Test
    void reportsADeviceWhoseUserIsForeign() throws Exception {
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        addDesired(DesiredDeviceFixture.thermometer("hoeing", 2));
        rejected.put(SECRET.device("hoeing", device.device()).user(), "somebody else's");

        assertThat(provisioning.step().rejected())
                .containsExactly(Map.entry(device.version().key(), "somebody else's"));

        rejected.clear();
        provisioning.refresh();
        assertThat(provisioning.step()).isEqualTo(DONE);
    }

    @Test
    void mapsAttributeNamesOfRealDevicesAndSetsTheirPlace() throws Exception {
        ObjectNode settings = (ObjectNode) NgsiJson.mapper().readTree("""
                {"at": {"latitude": 40.3, "longitude": -3.5}, "attributes": [
                  {"object_id": "t", "name": "Temperature", "unit": "CEL"}, {"object_id": "ph", "name": "Acidity", "type": "Float"}]}""");
        DeviceVersion version = DesiredDeviceFixture.thermometer("hoeing", 1).version();
        addDesired(new DesiredDevice(version, "Thermometer", "probe", true, null, false, settings, null, 0));
        addDesired(new DesiredDevice(
                DesiredDeviceFixture.thermometer("hoeing", 2).version(),
                "Thermometer",
                "simulated",
                true,
                null,
                true,
                settings,
                null,
                0));

        assertThat(provisioning.step()).isEqualTo(DONE);

        JsonNode probe = agent.devices.get("probe");
        assertThat(probe.path("attributes").findValuesAsText("object_id"))
                .containsExactlyInAnyOrder("t", "ph", "stat", "time", "where", "bat");
        assertThat(probe.at("/attributes/0").toString())
                .isEqualTo("{\"object_id\":\"t\",\"name\":\"Temperature\",\"type\":\"Number\","
                        + "\"metadata\":{\"unitCode\":{\"type\":\"Text\",\"value\":\"CEL\"}}}");
        assertThat(probe.path("static_attributes").toString())
                .contains("{\"name\":\"Latitude\",\"type\":\"Float\",\"value\":40.3}");
        assertThat(agent.devices.get("simulated").path("attributes").findValuesAsText("object_id"))
                .contains("temp", "lat", "lon");
        provisioning.refresh();
        int changes = agent.changes.size();
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.changes).as("the agent already has the desired state").hasSize(changes);
    }

    /** After a power cut a device list may be older than the records that refer to it. */
    @Test
    void removesNothingOfADeviceWhoseListIsOfAnotherVersion() throws Exception {
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        provisioning.step();
        desired.clear();
        addDesired(new DesiredDevice(
                device.version(),
                device.type(),
                device.device(),
                true,
                null,
                true,
                device.settings(),
                new GroupRef(0, 0, 0, 2),
                0));
        provisioning = provisioning();

        provisioning.step();

        assertThat(agent.deviceIds()).containsExactly(device.device());
        assertThat(agent.apiKeys()).containsExactly(KEY);
        assertThat(authenticates(SECRET.device("hoeing", device.device()))).isTrue();
        assertThat(desired.undecidedFault().text()).contains("1 devices", device.device());
    }

    @Test
    void removesNothingWhileARecordOfADeviceCannotBeRead() throws Exception {
        DesiredDevice device = DesiredDeviceFixture.thermometer("hoeing", 1);
        addDesired(device);
        provisioning.step();
        desired.clear();
        desired.takeUnreadable("farm|/|" + device.device());
        provisioning = provisioning();

        provisioning.step();

        assertThat(agent.deviceIds()).containsExactly(device.device());
        assertThat(authenticates(SECRET.device("hoeing", device.device()))).isTrue();
        assertThat(desired.undecidedFault().text()).contains("1 devices", device.device());

        desired.take("farm|/|" + device.device(), null);
        provisioning.step();
        assertThat(agent.deviceIds()).isEmpty();
        assertThat(authenticates(SECRET.device("hoeing", device.device()))).isFalse();
    }
}
