package io.furrow.simulators.fleet;

import java.net.URI;
import java.time.Duration;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Queue;
import java.util.Set;
import java.util.concurrent.ConcurrentHashMap;
import java.util.concurrent.ConcurrentLinkedQueue;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;

import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.device.FleetSettings;
import io.furrow.simulators.device.MqttTestClient;
import io.furrow.simulators.mqtt.MqttAccess;
import io.furrow.simulators.scenario.DesiredDeviceReader;

import static java.nio.charset.StandardCharsets.UTF_8;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

@Tag("full")
class DeviceLifecycleTest {
    private static final FarmSecret SECRET = new FarmSecret("0123456789abcdef".getBytes(UTF_8));
    private static final int MAX_OWN = 3;

    private final Map<String, String> passwords = new ConcurrentHashMap<>();
    private final Set<String> connectedAs = ConcurrentHashMap.newKeySet();
    private final Set<String> up = ConcurrentHashMap.newKeySet();
    private final Queue<String> failures = new ConcurrentLinkedQueue<>();
    private EmbeddedMqtt mqtt;
    private MqttTestClient listener;
    private FarmFleet fleet;
    private volatile FarmSecret secret = SECRET;

    @BeforeEach
    void start() throws Exception {
        // Those with a password may do everything.
        mqtt = EmbeddedMqtt.start(
                0,
                Map.of("farmer", "plough"),
                new EmbeddedMqtt.Users(
                        this::authenticates,
                        passwords::containsKey,
                        (user, topic) -> passwords.containsKey(user),
                        (user, filter) -> passwords.containsKey(user)));
        FleetSettings settings =
                new FleetSettings(URI.create("http://127.0.0.1:1"), null, mqtt.uri(), "farmer", "plough", "farm", "/");
        listener = new MqttTestClient(settings);
        FleetAccess access =
                new FleetAccess(settings, new MqttAccess(mqtt.uri(), null, 1), FleetAccess.Logins.of(() -> secret));
        fleet = FarmFleet.open(
                access, new Connections(access, mission -> secret.apiKey(mission), MAX_OWN), new FleetEvents() {
                    @Override
                    public void up(String device) {
                        up.add(device);
                    }

                    @Override
                    public void failed(String device, int attempts, String reason) {
                        failures.add(device + " " + attempts + " " + reason);
                    }
                });
    }

    @AfterEach
    void stop() {
        fleet.close();
        listener.close();
        mqtt.close();
    }

    @Test
    void givesAMissionAGatewayWhoseDevicesWouldBeTooManyConnections() throws Exception {
        letIn("small", 2);
        letInGateway("large");
        fleet.add(mission("small", 2));
        await().until(() -> up.size() == 2);
        fleet.add(mission("large", 2));
        await().until(() -> up.size() == 4);
        assertThat(fleet.connections()).isEqualTo(3);

        listener.publish(topic("large", 2, "cmd"), "{\"off\": \"\"}");
        await().untilAsserted(() -> assertThat(listener.received(topic("large", 2, "cmdexe")))
                .singleElement()
                .hasToString("{\"off\":\"ok\"}"));
        assertThat(listener.received(topic("large", 1, "cmdexe"))).isEmpty();

        fleet.remove("large-1");
        fleet.remove("large-2");
        await().until(() -> fleet.connections() == 2);
        int before = listener.received(topic("large", 1, "attrs")).size();
        int other = listener.received(topic("small", 1, "attrs")).size();
        await().until(() -> listener.received(topic("small", 1, "attrs")).size() > other + 10);
        assertThat(listener.received(topic("large", 1, "attrs"))).hasSize(before);
    }

    @Test
    void triesARefusedLoginUntilItIsKnownAndNotWhenTheDeviceIsGone() throws Exception {
        fleet.add(mission("late", 2));
        await().until(() -> failures.stream().anyMatch(failure -> failure.startsWith("late-1 3 the MQTT broker")));
        assertThat(failures).allMatch(failure -> failure.contains("refuses user 'furrow.d.late.late-"));
        assertThat(up).isEmpty();
        fleet.remove("late-2");

        letIn("late", 2);

        await().until(() -> !listener.received(topic("late", 1, "attrs")).isEmpty());
        assertThat(up).containsExactly("late-1");
        assertThat(listener.received(topic("late", 2, "attrs"))).isEmpty();
        assertThat(fleet.connections()).isEqualTo(1);
    }

    /** A device continues with its old login until the broker takes the new one: nothing is lost in between. */
    @Test
    void movesToNewLoginsWithoutAGapAndTriesUntilTheyAreKnown() throws Exception {
        letIn("small", 2);
        letInGateway("large");
        fleet.add(mission("small", 2));
        await().until(() -> up.size() == 2);
        fleet.add(mission("large", 2));
        await().until(() -> up.size() == 4);
        Instant now = Instant.now();

        secret = SECRET.rotated(now, now.plusSeconds(60), false);
        fleet.renew();
        await().until(() -> failures.stream().anyMatch(failure -> failure.contains("furrow.d.small.small-1.2.0'")));
        assertThat(fleet.connections()).isEqualTo(3);
        int before = listener.received(topic("small", 1, "attrs")).size();
        await().until(() -> listener.received(topic("small", 1, "attrs")).size() > before + 5);

        letIn(secret, "small", 2);
        FarmSecret.Login gateway = secret.gateway("large");
        passwords.put(gateway.user(), gateway.password());
        await().until(() -> connectedAs.containsAll(List.of(
                secret.device("small", "small-1").user(),
                secret.device("small", "small-2").user(),
                gateway.user())));
        passwords.keySet().removeIf(user -> user.endsWith(".1.0") || user.endsWith(".1"));
        int moved = listener.received(topic("large", 1, "attrs")).size();
        await().until(() -> listener.received(topic("large", 1, "attrs")).size() > moved + 5);
        listener.publish(topic("large", 2, "cmd"), "{\"off\": \"\"}");
        await().until(() -> !listener.received(topic("large", 2, "cmdexe")).isEmpty());

        assertThat(fleet.connections()).isEqualTo(3);
        assertThat(fleet.drain(Duration.ofSeconds(20))).isTrue();
        // All reports, and the answer to the command.
        assertThat(fleet.tally()).isEqualTo(new FarmFleet.Tally(fleet.reports() + 1, 0, 0));
    }

    private void letIn(String mission, int devices) {
        letIn(SECRET, mission, devices);
    }

    private void letIn(FarmSecret secret, String mission, int devices) {
        for (int number = 1; number <= devices; number++) {
            FarmSecret.Login login = secret.device(mission, mission + "-" + number);
            passwords.put(login.user(), login.password());
        }
    }

    private void letInGateway(String mission) {
        FarmSecret.Login login = SECRET.gateway(mission);
        passwords.put(login.user(), login.password());
    }

    private static String topic(String mission, int number, String end) {
        return "/" + SECRET.apiKey(mission) + "/" + mission + "-" + number + "/" + end;
    }

    private static List<FarmFleet.Member> mission(String mission, int devices) throws Exception {
        List<FarmFleet.Member> members = new ArrayList<>();
        Instant now = Instant.now();
        for (int number = 1; number <= devices; number++) {
            String id = mission + "-" + number;
            DeviceVersion version =
                    new DeviceVersion("urn:" + id, "farm", "/", "farm", mission, now.toEpochMilli(), null, 1, null);
            ObjectNode settings = JsonNodeFactory.instance.objectNode();
            settings.putArray("path").addArray().add(-3.5).add(40.3);
            var desired = DesiredDevice.simulated(version, "Thermometer", id, true, Duration.ofMillis(50), settings);
            members.add(new FarmFleet.Member(
                    new DesiredDeviceReader(Map.of(), 0).read(desired), FiwareScope.of("farm", "/"), now));
        }
        return members;
    }

    private boolean authenticates(String user, byte[] password) {
        boolean known = new String(password, UTF_8).equals(passwords.get(user));
        if (known) {
            connectedAs.add(user);
        }
        return known;
    }
}
