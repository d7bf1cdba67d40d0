package io.furrow.simulators.host;

import java.nio.file.Path;
import java.time.Instant;
import java.util.List;

import org.junit.jupiter.api.AfterEach;
import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.BeforeAll;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import io.furrow.model.device.DeviceStatus;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.topic.Topics;
import io.furrow.simulators.device.MqttTestClient;

import static io.furrow.simulators.host.HostFixture.SECRET;
import static io.furrow.simulators.host.HostFixture.entity;
import static io.furrow.simulators.host.HostFixture.topic;
import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

/** A host against a real Kafka and MQTT broker; each test has a mission of its own. */
@Tag("full")
class DeviceHostIT {
    private static final String YARD = "{\"path\": [[-3.48, 40.31]]}";

    @TempDir
    private static Path directory;

    @AutoClose
    private static HostFixture bench;

    private DeviceHost host;
    private MqttTestClient listener;

    @BeforeAll
    static void startBench() throws Exception {
        bench = new HostFixture(directory);
    }

    @BeforeEach
    void start() throws Exception {
        listener = bench.listener();
        host = DeviceHost.start(bench.settings());
    }

    @AfterEach
    void stop() {
        host.close();
        listener.close();
    }

    @Test
    void runsWhatIsDesiredFromWhenTheBrokerAcceptsIt() throws Exception {
        String device = entity("Thermometer", "late", 1);
        long sequence = bench.addDesired("late", device, true, YARD);
        await().untilAsserted(() -> assertThat(bench.status(device)).hasValueSatisfying(status -> {
            assertThat(status.state()).isEqualTo(State.FAILED);
            assertThat(status.reason())
                    .contains("refuses user 'furrow.d.late.urn%3Angsi-ld%3AThermometer%3Alate-1.1.0'");
        }));

        bench.admit("late", device);

        await().untilAsserted(() ->
                assertThat(bench.status(device)).contains(new DeviceStatus(sequence, State.RUNNING, null)));
        await().untilAsserted(() ->
                assertThat(listener.received(topic("late", device, "attrs"))).hasSizeGreaterThan(3));
    }

    @Test
    void beginsAnewAfterAFailureThatNobodyForesaw() throws Exception {
        String device = run("anew", 1);
        FarmSecret before = bench.secret;
        bench.secret = null;
        await().untilAsserted(() -> assertThat(host.lastFailure()).contains("null"));
        bench.secret = before;

        await().until(host::isCaughtUp);
        await().until(() -> host.fleet().connections() == 1);
        int received = received("anew", device);
        await().until(() -> received("anew", device) > received);
        assertThat(host.isAlive()).isTrue();
        bench.delete(device);
    }

    @Test
    void stopsWhatIsNoLongerDesiredAndForgetsWhatIsDeleted() throws Exception {
        String stopped = run("end", 1);
        String deleted = run("end", 2);
        String goesOn = run("end", 3);

        long sequence = bench.addDesired("end", stopped, false, YARD);
        bench.delete(deleted);

        await().untilAsserted(() ->
                assertThat(bench.status(stopped)).contains(new DeviceStatus(sequence, State.STOPPED, null)));
        await().untilAsserted(() -> assertThat(bench.status(deleted)).isEmpty());
        await().until(() -> host.fleet().connections() == 1);
        int before = received("end", stopped) + received("end", deleted);
        int other = received("end", goesOn);
        await().until(() -> received("end", goesOn) > other + 10);
        assertThat(received("end", stopped) + received("end", deleted)).isEqualTo(before);
        bench.delete(goesOn);
    }

    @Test
    void goesOnAfterARestartAndTakesBackWhatIsGone() throws Exception {
        String device = run("again", 1);
        String gone = run("again", 2);
        host.close();
        bench.delete(gone);
        long sequence = bench.addDesired("again", device, true, "{\"path\": [[-3.5, 40.31]]}");

        host = DeviceHost.start(bench.settings());

        await().untilAsserted(() ->
                assertThat(bench.status(device)).contains(new DeviceStatus(sequence, State.RUNNING, null)));
        await().untilAsserted(() -> assertThat(bench.status(gone)).isEmpty());
        await().until(() -> listener.received(topic("again", device, "attrs")).stream()
                .anyMatch(json -> json.path("lon").doubleValue() == -3.5));
        bench.delete(device);
    }

    @Test
    void reportsWhichSettingIsWrongAndTriesAgainWhenTheFieldComes() throws Exception {
        String device = entity("Thermometer", "field", 1);
        bench.admit("field", device);
        bench.addDesired("field", device, true, "{\"area\": \"orchard\"}");
        await().untilAsserted(() -> assertThat(bench.status(device))
                .hasValueSatisfying(
                        status -> assertThat(status.reason()).startsWith("area: there is no field 'orchard'")));

        bench.put(Topics.FIELDS, "orchard@2020-01-01T00:00:00.000Z", """
                {"type": "Feature", "id": "orchard", "properties": {"validFrom": "2020-01-01T00:00:00Z"}, "geometry": {"type": "Polygon",
                 "coordinates": [[[-3.5, 40.3], [-3.49, 40.3], [-3.49, 40.31], [-3.5, 40.3]]]}}
                """);

        await().untilAsserted(() ->
                assertThat(bench.status(device).map(DeviceStatus::state)).contains(State.RUNNING));
        bench.delete(device);
    }

    @Test
    void carriesADeviceOnARobotThatComesLater() throws Exception {
        String robot = entity("Robot", "carry", 1);
        String camera = entity("Camera", "carry", 1);
        bench.admit("carry", camera);
        bench.addDesired(
                "carry",
                camera,
                true,
                "{\"carriedBy\": \"%s\", \"parameters\": {\"battery\": \"P3D\"}}".formatted(robot));
        await().untilAsserted(() -> assertThat(bench.status(camera).map(DeviceStatus::reason))
                .contains("carriedBy: '" + robot + "' is not a robot that runs here"));

        bench.addDesired("carry", robot, true, "{\"path\": [[-3.48, 40.31], [-3.48, 40.32]], \"speed\": 2}");

        await().untilAsserted(() -> {
            assertThat(bench.status(robot).map(DeviceStatus::state)).contains(State.RUNNING);
            assertThat(bench.status(camera).map(DeviceStatus::state)).contains(State.RUNNING);
            assertThat(listener.received(topic("carry", camera, "attrs")))
                    .last()
                    .satisfies(json -> {
                        assertThat(json.path("lat").doubleValue()).isGreaterThan(40.31);
                        assertThat(json.path("bat").doubleValue()).isBetween(0.2, 1d);
                    });
        });
        bench.delete(camera);
        bench.delete(robot);
    }

    @Test
    void restartsADeviceAndReportsWhenItIsBack() throws Exception {
        String device = run("restart", 1);
        listener.publish(topic("restart", device, "cmd"), "{\"restart\": \"\"}");

        await().untilAsserted(() -> assertThat(listener.received(topic("restart", device, "cmdexe")))
                .singleElement()
                .hasToString("{\"restart\":\"ok\"}"));
        List<Long> times = listener.received(topic("restart", device, "attrs")).stream()
                .map(json -> json.path("time").longValue())
                .toList();
        long longest = 0;
        for (int i = 1; i < times.size(); i++) {
            longest = Math.max(longest, times.get(i) - times.get(i - 1));
        }
        assertThat(longest).as("ms without a measure, by the device's clock").isGreaterThanOrEqualTo(1900);
        bench.delete(device);
    }

    @Test
    void connectsAgainWithTheNewCredentialsOfADevice() throws Exception {
        String device = run("stolen", 1);
        bench.passwords.remove(SECRET.device("stolen", device).user());
        FarmSecret.Login login = SECRET.device("stolen", device, 1);
        bench.passwords.put(login.user(), login.password());

        long sequence = bench.addRotated("stolen", device, YARD, 1);

        await().untilAsserted(() ->
                assertThat(bench.status(device)).contains(new DeviceStatus(sequence, State.RUNNING, null)));
        int before = received("stolen", device);
        await().until(() -> received("stolen", device) > before + 3);
        bench.delete(device);
    }

    @Test
    void takesUpASecretThatIsRotatedWhileItsDevicesGoOn() throws Exception {
        String device = run("rotated", 1);
        bench.putFingerprints(SECRET);
        Instant now = Instant.now();
        FarmSecret rotated = SECRET.rotated(now, now.plusSeconds(60), false);
        FarmSecret.Login login = rotated.device("rotated", device);
        bench.passwords.put(login.user(), login.password());

        bench.secret = rotated;
        // One that is requested from now on has the new login only.
        String second = entity("Thermometer", "rotated", 2);
        FarmSecret.Login other = rotated.device("rotated", second);
        bench.passwords.put(other.user(), other.password());
        long sequence = bench.addDesired("rotated", second, true, YARD);

        await().untilAsserted(() ->
                assertThat(bench.status(second)).contains(new DeviceStatus(sequence, State.RUNNING, null)));
        bench.passwords.remove(SECRET.device("rotated", device).user());
        int before = received("rotated", device);
        await().until(() -> received("rotated", device) > before + 10);
        bench.secret = SECRET;
        bench.delete(device);
        bench.delete(second);
    }

    private String run(String mission, int number) throws Exception {
        String device = entity("Thermometer", mission, number);
        bench.admit(mission, device);
        long sequence = bench.addDesired(mission, device, true, YARD);
        await().untilAsserted(() -> {
            assertThat(bench.status(device)).contains(new DeviceStatus(sequence, State.RUNNING, null));
            assertThat(received(mission, device)).isPositive();
        });
        return device;
    }

    private int received(String mission, String device) {
        return listener.received(topic(mission, device, "attrs")).size();
    }
}
