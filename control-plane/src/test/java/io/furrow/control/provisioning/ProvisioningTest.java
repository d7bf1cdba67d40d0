package io.furrow.control.provisioning;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.HashSet;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.Set;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.control.provisioning.Provisioning.Outcome;
import io.furrow.control.secret.SecretSource;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.device.WantedDevice;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class ProvisioningTest {
    private static final Outcome DONE = new Outcome(Map.of(), null, true);
    private static final String KEY = Wanted.SECRET.apiKey("hoeing");

    private final WantedDevices wanted = new WantedDevices(Wanted.SCOPE);
    private final LiveAccounts accounts = new LiveAccounts();
    /** How many accounts there were after each change. */
    private final List<Integer> counts = new ArrayList<>();

    private final Map<String, String> refused = new HashMap<>();
    private FakeAgent agent;
    private Provisioning provisioning;

    @BeforeEach
    void start() throws IOException {
        agent = FakeAgent.start();
        provisioning = provisioning();
    }

    @AfterEach
    void stop() {
        agent.close();
    }

    @Test
    void provisionsTheDevicesOfAMissionUnderItsKeyWithItsNameInEveryMeasure() throws Exception {
        want(Wanted.thermometer("hoeing", 1));
        want(Wanted.device("WeatherStation", "hoeing", "station", 1));

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
    void leavesRobotsAndWhatReportsByItselfAlone() throws Exception {
        want(Wanted.device("Robot", "hoeing", "robot", 1));
        want(new WantedDevice(
                Wanted.thermometer("hoeing", 1).version(),
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
    void givesEachDeviceAnAccountOnceTheAgentKnowsIt() throws Exception {
        want(Wanted.thermometer("hoeing", 1));
        want(Wanted.thermometer("hoeing", 2));
        agent.away = true;
        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("503");
        assertThat(counts).isEmpty();

        agent.away = false;
        provisioning.step();

        assertThat(counts).containsExactly(2);
        String device = "urn:ngsi-ld:Thermometer:hoeing-1";
        var login = Wanted.SECRET.device("hoeing", device);
        assertThat(accounts.knows(login.user(), login.password().getBytes())).isTrue();
        assertThat(accounts.mayWrite(login.user(), "/" + KEY + "/" + device + "/attrs"))
                .isTrue();
    }

    @Test
    void givesMissionsAGatewayOnlyWhereOneIsUsed() throws Exception {
        want(Wanted.thermometer("hoeing", 1));
        String gateway = Wanted.SECRET.gateway("hoeing").user();
        provisioning.step();
        assertThat(accounts.mayRead(gateway, "/" + KEY + "/+/cmd")).isFalse();

        provisioning = new Provisioning(settings(SecretSource.of(Wanted.SECRET), true), wanted, System::nanoTime);
        provisioning.step();

        assertThat(counts).containsExactly(1, 2);
        assertThat(accounts.mayRead(gateway, "/json/" + KEY + "/+/cmd")).isTrue();
    }

    @Test
    void takesAwayWhatIsStoppedAndWhatIsDeleted() throws Exception {
        WantedDevice first = Wanted.thermometer("hoeing", 1);
        WantedDevice second = Wanted.thermometer("weeding", 1);
        want(first);
        want(second);
        provisioning.step();

        want(Wanted.stopped(first));
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.deviceIds()).containsExactly(second.device());
        assertThat(agent.apiKeys()).containsExactly(Wanted.SECRET.apiKey("weeding"));
        assertThat(accounts.mayRead(
                        Wanted.SECRET.device("hoeing", first.device()).user(),
                        "/" + KEY + "/" + first.device() + "/cmd"))
                .isFalse();

        wanted.take(second.version().key(), null);
        assertThat(provisioning.step()).isEqualTo(DONE);
        assertThat(agent.deviceIds()).isEmpty();
        assertThat(agent.apiKeys()).isEmpty();
        assertThat(counts).containsExactly(2, 1, 0);
    }

    @Test
    void changesNothingAfterARestartButLeftoversOfItsOwn() throws Exception {
        want(Wanted.thermometer("hoeing", 1));
        want(Wanted.thermometer("gone", 1));
        provisioning.step();
        ObjectNode foreign = JsonNodeFactory.instance
                .objectNode()
                .put("device_id", "foreign")
                .put("apikey", "secret");
        agent.devices.put("foreign", foreign);
        agent.changes.clear();

        wanted.clear();
        want(Wanted.thermometer("hoeing", 1));
        assertThat(provisioning().step()).isEqualTo(DONE);

        assertThat(agent.changes)
                .containsExactly("DELETE /iot/devices/urn:ngsi-ld:Thermometer:gone-1", "DELETE /iot/services");
        assertThat(agent.deviceIds()).containsExactlyInAnyOrder("foreign", "urn:ngsi-ld:Thermometer:hoeing-1");
    }

    @Test
    void provisionsAnewWhatTheAgentHasOtherwise() throws Exception {
        want(Wanted.device("Thermometer", "hoeing", "d", 1));
        provisioning.step();
        want(Wanted.device("Camera", "hoeing", "d", 2));

        assertThat(provisioning.step()).isEqualTo(DONE);

        assertThat(agent.devices.get("d").path("entity_type").asText()).isEqualTo("Camera");
    }

    @Test
    void refusesADeviceThatSomebodyElseHasProvisioned() throws Exception {
        agent.devices.put(
                "d", JsonNodeFactory.instance.objectNode().put("device_id", "d").put("apikey", "secret"));
        WantedDevice device = Wanted.device("Thermometer", "hoeing", "d", 1);
        want(device);

        assertThat(provisioning.step().refused().get(device.version().key())).contains("somebody else has provisioned");
        assertThat(agent.devices.get("d").path("apikey").asText()).isEqualTo("secret");
    }

    @Test
    void makesTheOthersOfABatchThoughTheAgentRefusesSome() throws Exception {
        for (int i = 1; i <= 250; i++) {
            want(Wanted.thermometer("hoeing", i));
            if (i <= 120) {
                agent.disliked.add("urn:ngsi-ld:Thermometer:hoeing-" + i);
            }
        }

        Outcome outcome = provisioning.step();
        for (int steps = 0; !outcome.done() && steps < 10; steps++) {
            outcome = provisioning.step();
        }

        assertThat(outcome.done()).isTrue();
        assertThat(outcome.refused())
                .hasSize(120)
                .allSatisfy((key, reason) -> assertThat(reason).contains("422", "not urn"));
        assertThat(agent.deviceIds()).hasSize(130);
        assertThat(counts.get(counts.size() - 1)).isEqualTo(130);

        agent.disliked.clear();
        provisioning.lookAgain();
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }
        assertThat(agent.deviceIds()).hasSize(250);
    }

    @Test
    void takesNoAccountAwayWhileAnAgentThatHasLostItsMemoryLearns() throws Exception {
        for (int i = 1; i <= 250; i++) {
            want(Wanted.thermometer("hoeing", i));
        }
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }
        agent.restart();
        counts.clear();

        provisioning.lookAgain();
        while (!provisioning.step().done()) {
            assertThat(agent.deviceIds()).hasSizeLessThan(250);
        }

        assertThat(agent.deviceIds()).hasSize(250);
        assertThat(counts).isEmpty();
    }

    @Test
    void acceptsOldAndNewPasswordsWhileASecretIsRotatedAndDoesNotProvisionAnew() throws Exception {
        Secret secret = new Secret();
        provisioning = new Provisioning(settings(secret, false), wanted, System::nanoTime);
        WantedDevice device = Wanted.thermometer("hoeing", 1);
        want(device);
        provisioning.step();
        assertThat(provisioning.isSecretChanged()).isFalse();
        agent.changes.clear();
        Instant until = Instant.parse("2026-03-01T08:00:00Z");
        FarmSecret rotated = Wanted.SECRET.rotated(until.minusSeconds(60), until, false);

        secret.current = rotated.at(until.minusSeconds(1));
        assertThat(provisioning.isSecretChanged()).isTrue();
        provisioning.step();
        assertThat(knows(Wanted.SECRET.device("hoeing", device.device()))).isTrue();
        assertThat(knows(rotated.device("hoeing", device.device()))).isTrue();

        secret.current = rotated.at(until);
        assertThat(provisioning.isSecretChanged()).isTrue();
        provisioning.step();
        assertThat(knows(Wanted.SECRET.device("hoeing", device.device()))).isFalse();
        assertThat(knows(rotated.device("hoeing", device.device()))).isTrue();
        assertThat(agent.changes).isEmpty();
        assertThat(counts).containsExactly(1, 2, 1);
    }

    @Test
    void movesWhatHasAnApiKeyOfAnOlderKeyAndLeavesWhatOthersHave() throws Exception {
        Secret secret = new Secret();
        WantedDevice device = Wanted.thermometer("hoeing", 1);
        want(device);
        want(Wanted.thermometer("gone", 1));
        new Provisioning(settings(secret, false), wanted, System::nanoTime).step();
        agent.devices.put(
                "foreign",
                JsonNodeFactory.instance
                        .objectNode()
                        .put("device_id", "foreign")
                        .put("apikey", "secret"));
        wanted.clear();
        want(device);
        secret.current =
                Wanted.SECRET.rotated(Instant.now(), Instant.EPOCH, true).at(Instant.now());

        assertThat(new Provisioning(settings(secret, false), wanted, System::nanoTime).step())
                .isEqualTo(DONE);

        assertThat(agent.deviceIds()).containsExactlyInAnyOrder(device.device(), "foreign");
        assertThat(agent.apiKeys()).containsExactly(secret.current.apiKey("hoeing"));
        assertThat(agent.devices.get(device.device()).path("apikey").asText())
                .isEqualTo(secret.current.apiKey("hoeing"));
        assertThat(knows(secret.current.device("hoeing", device.device()))).isTrue();
    }

    /** A stolen device must not wait for an agent. */
    @Test
    void refusesAnOldPasswordThoughTheAgentIsAway() throws Exception {
        WantedDevice stolen = Wanted.thermometer("hoeing", 1);
        WantedDevice other = Wanted.thermometer("hoeing", 2);
        want(stolen);
        want(other);
        provisioning.step();
        agent.away = true;
        provisioning.lookAgain();
        want(stolen.withGeneration(1));

        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessageContaining("503");
        assertThat(knows(Wanted.SECRET.device("hoeing", stolen.device()))).isFalse();
        assertThat(knows(Wanted.SECRET.device("hoeing", other.device()))).isTrue();

        agent.away = false;
        provisioning.step();
        assertThat(knows(Wanted.SECRET.device("hoeing", stolen.device(), 1))).isTrue();
        assertThat(knows(Wanted.SECRET.device("hoeing", stolen.device()))).isFalse();
        assertThat(knows(Wanted.SECRET.device("hoeing", other.device()))).isTrue();
        assertThat(agent.changes)
                .filteredOn(change -> change.startsWith("DELETE"))
                .isEmpty();
    }

    @Test
    void doesNothingWithASecretThatIsNotTheFarms() throws Exception {
        want(Wanted.thermometer("hoeing", 1));
        provisioning.step();
        agent.changes.clear();
        counts.clear();
        Secret another = new Secret();
        another.current = FarmSecret.generate();
        another.foreign = "this farm has another secret";
        provisioning = new Provisioning(settings(another, false), wanted, System::nanoTime);

        assertThatThrownBy(provisioning::step).isInstanceOf(IOException.class).hasMessage(another.foreign);

        assertThat(agent.changes).isEmpty();
        assertThat(counts).isEmpty();
        assertThat(knows(Wanted.SECRET.device("hoeing", "urn:ngsi-ld:Thermometer:hoeing-1")))
                .isTrue();
    }

    @Test
    void saysOfADeviceThatSomebodyElseHasItsUser() throws Exception {
        WantedDevice device = Wanted.thermometer("hoeing", 1);
        want(device);
        want(Wanted.thermometer("hoeing", 2));
        refused.put(Wanted.SECRET.device("hoeing", device.device()).user(), "somebody else's");

        assertThat(provisioning.step().refused())
                .containsExactly(Map.entry(device.version().key(), "somebody else's"));

        refused.clear();
        provisioning.lookAgain();
        assertThat(provisioning.step()).isEqualTo(DONE);
    }

    @Test
    void takesTheAttributesOfOwnTypesFromTheirParameters() throws Exception {
        ObjectNode settings = JsonNodeFactory.instance.objectNode();
        settings.putObject("parameters")
                .putArray("attributes")
                .addObject()
                .put("object_id", "ph")
                .put("name", "Acidity")
                .put("type", "Float");
        want(Wanted.device("SoilProbe", "hoeing", "probe", 1, settings));
        ObjectNode wrong = JsonNodeFactory.instance.objectNode();
        wrong.putObject("parameters").put("attributes", "ph");
        WantedDevice other = Wanted.device("SoilProbe", "hoeing", "other", 1, wrong);
        want(other);

        Outcome outcome = provisioning.step();

        assertThat(agent.devices.get("probe").path("attributes").findValuesAsText("name"))
                .contains("Acidity", "battery");
        assertThat(outcome.refused()).containsOnlyKeys(other.version().key());
        assertThat(outcome.refused().values().iterator().next()).contains("'attributes' of its parameters");
    }

    private Provisioning provisioning() {
        return new Provisioning(settings(SecretSource.of(Wanted.SECRET), false), wanted, System::nanoTime);
    }

    private ProvisioningSettings settings(SecretSource secret, boolean gateways) {
        return new ProvisioningSettings(
                new Properties(),
                Wanted.SCOPE,
                secret,
                AgentSettings.at(agent.uri()),
                List.of(accounts, new Counted()),
                gateways);
    }

    private void want(WantedDevice device) {
        wanted.take(device.version().key(), device);
    }

    private boolean knows(FarmSecret.Login login) {
        return accounts.knows(login.user(), login.password().getBytes(StandardCharsets.UTF_8));
    }

    /** Counts accounts at each change, and refuses users that somebody else has. */
    private final class Counted implements MqttAccounts {
        private final Set<String> users = new HashSet<>();

        @Override
        public Map<String, String> replace(List<MqttAccount> all) {
            users.clear();
            all.forEach(account -> users.add(account.login().user()));
            counts.add(all.size());
            return Map.copyOf(refused);
        }

        @Override
        public void retain(Set<String> some) {
            if (users.retainAll(some)) {
                counts.add(users.size());
            }
        }
    }

    /** The farm's secret, as long as nobody says that it is not. */
    private static final class Secret implements SecretSource {
        private FarmSecret current = Wanted.SECRET;
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
