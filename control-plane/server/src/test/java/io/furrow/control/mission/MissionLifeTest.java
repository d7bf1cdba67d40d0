package io.furrow.control.mission;

import java.time.Duration;
import java.time.Instant;
import java.util.Map;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.device.DesiredDevice;
import io.furrow.model.device.DeviceConnection;
import io.furrow.model.device.DeviceConnection.RefusedLogin;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.topic.Topics;

import static io.furrow.control.mission.FarmFixture.TIMEOUT;
import static io.furrow.control.mission.FarmFixture.group;
import static org.assertj.core.api.Assertions.assertThat;

class MissionLifeTest {
    private final FarmFixture farm = new FarmFixture();

    @BeforeEach
    void createADomain() throws Exception {
        farm.domain("north");
    }

    @Test
    void runsFromStartingToStopped() throws Exception {
        assertThat(farm.start("m", "north", group("Thermometer", 2)).json().toString())
                .isEqualTo("{\"type\":\"response\",\"status\":\"created\",\"mission\":\"m\",\"domain\":\"north\","
                        + "\"domain_topic\":\"data.north.realtime\",\"mission_topic\":\"data.north.realtime.m\"}");
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);

        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-1"), State.RUNNING);
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-2"), State.RUNNING);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);

        assertThat(farm.request(new MissionCommand.Stop("m")).json().toString())
                .isEqualTo("{\"type\":\"response\",\"status\":\"deleted\",\"mission\":\"m\"}");
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
        farm.hostAll();
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    /** As requested by the WeLASER dashboard: existing devices report with the name of the mission. */
    @Test
    void runsImmediatelyWithoutDevices() throws Exception {
        farm.request(new MissionCommand.Start("m", "north", new MissionPlan.Unspecified(), null, null));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        farm.request(new MissionCommand.Stop("m"));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    @Test
    void publishesTheMissionOfADeviceFromStartToEnd() throws Exception {
        long begin = farm.now;
        farm.start("m", "north", DeviceGroup.entity("urn:robot"));
        farm.pass(500);
        farm.request(new MissionCommand.Stop("m"));

        var version =
                DeviceVersion.read(farm.publisher.compacted(Topics.DEVICES).get("farm|/|urn:robot"));
        assertThat(version)
                .extracting(DeviceVersion::domain, DeviceVersion::mission, DeviceVersion::from, DeviceVersion::until)
                .containsExactly("north", "m", begin, begin + 500);
        assertThat(farm.publisher.all().stream().filter(each -> each.topic().equals(Topics.DEVICES)))
                .hasSize(2);

        farm.request(new MissionCommand.Delete("m"));
        assertThat(farm.publisher.compacted(Topics.DEVICES)).isEmpty();
    }

    @Test
    void namesDevicesThatDidNotStartInTime() throws Exception {
        farm.start("m", "north", group("Camera", 3));
        farm.report(farm.device("urn:ngsi-ld:Camera:m-1"), State.RUNNING);
        farm.report(farm.device("urn:ngsi-ld:Camera:m-2"), State.FAILED);
        farm.pass(TIMEOUT - 1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.pass(1);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        assertThat(farm.status("m").missing())
                .containsExactly(
                        new MissionStatus.Missing("urn:ngsi-ld:Camera:m-2", "why"),
                        new MissionStatus.Missing(
                                "urn:ngsi-ld:Camera:m-3",
                                "nothing simulates it: start ./furrow up with --simulate-devices, or ./furrow device-host",
                                "not-simulated",
                                null));

        farm.report(farm.device("urn:ngsi-ld:Camera:m-3"), State.RUNNING);
        assertThat(farm.status("m").missing()).hasSize(1);
        farm.report(farm.device("urn:ngsi-ld:Camera:m-1"), State.FAILED);
        assertThat(farm.status("m").missing()).contains(new MissionStatus.Missing("urn:ngsi-ld:Camera:m-1", "why"));
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
    }

    @Test
    void goesOnWhenTheClockIsSetBack() throws Exception {
        long hour = Duration.ofHours(1).toMillis();
        farm.request(new MissionCommand.Start(
                "m", "north", FarmFixture.devices(group("Camera", 2)), null, Duration.ofHours(1)));
        farm.report(farm.device("urn:ngsi-ld:Camera:m-1"), State.RUNNING);
        farm.pass(-24 * hour);
        farm.pass(TIMEOUT - 1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.pass(1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);

        farm.pass(hour - TIMEOUT);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
    }

    @Test
    void waitsForItsStartDateWhenTheClockIsSetBack() throws Exception {
        Instant begin = Instant.ofEpochMilli(farm.now + 1_000);
        farm.request(new MissionCommand.Start("m", "north", FarmFixture.devices(group("Camera", 1)), begin, null));
        farm.pass(-TIMEOUT);
        farm.pass(TIMEOUT);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.CREATED);
        farm.pass(1_000);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
    }

    @Test
    void waitsForItsFirstDevice() throws Exception {
        farm.start("m", "north", FarmFixture.real("Thermometer", 2), group("Camera", 2));
        farm.report(farm.device("urn:ngsi-ld:Camera:m-2"), State.FAILED);
        farm.pass(TIMEOUT);
        farm.pass(Duration.ofHours(3).toMillis());

        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        assertThat(farm.status("m").reason())
                .isEqualTo("4 of 4 devices are not up: urn:ngsi-ld:Thermometer:m-1 (it has not reported yet), "
                        + "urn:ngsi-ld:Thermometer:m-2 (it has not reported yet), urn:ngsi-ld:Camera:m-1 (nothing simulates it: "
                        + "start ./furrow up with --simulate-devices, or ./furrow device-host) and 1 more");
        assertThat(farm.status("m").missing()).contains(new MissionStatus.Missing("urn:ngsi-ld:Camera:m-2", "why"));
        assertThat(farm.all(farm.devices)).allMatch(each -> each.device().running());

        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-1"), State.FAILED);
        assertThat(farm.status("m").missing())
                .contains(new MissionStatus.Missing(
                        "urn:ngsi-ld:Thermometer:m-1", "why", "not-provisioned", Map.of("failure", "why")));
        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-1"), farm.now);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        assertThat(farm.status("m").missing()).hasSize(3);
        farm.hostAll();
        assertThat(farm.status("m").reason()).isNull();
        assertThat(farm.status("m").confirmed()).isEqualTo(4);
    }

    @Test
    void reportsTheBestReasonForAMissingDevice() throws Exception {
        farm.start("m", "north", FarmFixture.real("Thermometer", 1));
        DesiredDevice thermometer = farm.device("urn:ngsi-ld:Thermometer:m-1");
        farm.connect(thermometer, null);
        farm.pass(TIMEOUT);
        assertThat(reason()).startsWith("it has not connected to the MQTT broker since ");

        farm.connect(thermometer, refusedLogin(1));
        assertThat(reason()).startsWith("its password was refused once, at ");
        assertThat(farm.status("m").reason()).contains("urn:ngsi-ld:Thermometer:m-1 (" + reason() + ")");
        int written = farm.publisher.all().size();
        farm.now += 59_000;
        farm.connect(thermometer, refusedLogin(7));
        assertThat(farm.publisher.all()).as("only the count changed").hasSize(written);
        farm.now += 1000;
        farm.connect(thermometer, refusedLogin(8));
        assertThat(reason()).startsWith("its password was refused 8 times, last at ");

        farm.report(thermometer, farm.now);
        assertThat(farm.status("m").missing()).isEmpty();
    }

    private String reason() {
        return farm.status("m").missing().get(0).reason();
    }

    private RefusedLogin refusedLogin(long count) {
        return new RefusedLogin(count, farm.now, DeviceConnection.WRONG_PASSWORD, "furrow.d.m.x.1.0");
    }

    @Test
    void countsARealDeviceAfterItsFirstReport() throws Exception {
        farm.start("m", "north", FarmFixture.real("Thermometer", 1), DeviceGroup.entity("urn:robot"));
        DesiredDevice thermometer = farm.device("urn:ngsi-ld:Thermometer:m-1");
        farm.report(thermometer, farm.now - 1);
        farm.report(thermometer, State.RUNNING);
        farm.report(thermometer, State.STOPPED);
        assertThat(farm.status("m").confirmed()).isZero();

        farm.report(thermometer, farm.now);
        farm.report(thermometer, farm.now);
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
        farm.report(thermometer, State.FAILED);
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
        farm.report(farm.device("urn:robot"), farm.now);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);

        farm.request(new MissionCommand.Stop("m"));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(farm.device("urn:ngsi-ld:Thermometer:m-1").running()).isFalse();
    }

    @Test
    void stopsAfterTheTimeoutOfDevices() throws Exception {
        farm.start("m", "north", group("Camera", 1));
        farm.request(new MissionCommand.Stop("m"));
        farm.pass(TIMEOUT);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(farm.status("m").missing())
                .containsExactly(new MissionStatus.Missing("urn:ngsi-ld:Camera:m-1", null));
    }

    @Test
    void ignoresReportsWithAnOldSequence() throws Exception {
        farm.start("m", "north", group("Camera", 1));
        DesiredDevice earlier = farm.device("urn:ngsi-ld:Camera:m-1");
        farm.hostAll();
        farm.request(new MissionCommand.Stop("m"));

        farm.report(earlier, State.STOPPED);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
    }

    @Test
    void startsAtItsDateAndStopsAfterItsDuration() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        assertThat(farm.request(new MissionCommand.Start(
                                "m", "north", FarmFixture.devices(group("Camera", 1)), date, Duration.ofSeconds(5)))
                        .json()
                        .path("start")
                        .asLong())
                .isEqualTo(date.toEpochMilli());
        assertThat(farm.status("m").state()).isEqualTo(MissionState.CREATED);
        farm.pass(9_999);
        assertThat(farm.all(farm.devices)).isEmpty();
        farm.pass(1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.hostAll();
        farm.pass(4_999);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        farm.pass(1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
    }

    @Test
    void doesNotStartAfterACancelledStart() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        farm.request(new MissionCommand.Start("m", "north", FarmFixture.devices(group("Camera", 1)), date, null));
        farm.request(new MissionCommand.Stop("m"));
        farm.pass(20_000);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(farm.all(farm.devices)).isEmpty();
    }

    @Test
    void failsAtItsDateWithoutItsDomain() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        farm.request(new MissionCommand.Start("m", "north", FarmFixture.devices(), date, null));
        farm.run(() ->
                farm.domains.put("north", null)); // state of a version that did not delete missions with their domain
        farm.pass(10_000);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.FAILED);
        assertThat(farm.status("m").reason()).isEqualTo("at the start date: there is no domain 'north' any more");
    }

    @Test
    void rejectsInvalidCommands() throws Exception {
        farm.domain("south");
        farm.start("m", "north", group("Camera", 1), DeviceGroup.entity("urn:robot"));

        farm.rejects(ErrorCode.MISSION_RUNNING, () -> farm.start("m", "north"));
        farm.rejects(ErrorCode.UNKNOWN_MISSION, () -> farm.request(new MissionCommand.Stop("other")));
        farm.rejects(ErrorCode.UNKNOWN_MISSION, () -> farm.request(new MissionCommand.Delete("other")));
        farm.rejects(ErrorCode.MISSION_RUNNING, () -> farm.request(new MissionCommand.Delete("m")));
        farm.rejects(ErrorCode.UNKNOWN_DOMAIN, () -> farm.start("other", "east"));
        farm.rejects(ErrorCode.DEVICE_TAKEN, () -> farm.start("other", "south", DeviceGroup.entity("urn:robot")));
        farm.rejects(
                ErrorCode.DEVICE_TAKEN,
                () -> farm.start(
                        "other", "south", group("Camera", 1), DeviceGroup.entity("urn:ngsi-ld:Camera:other-1")));
        farm.rejects(
                ErrorCode.UNKNOWN_TEMPLATE,
                () -> farm.request(new MissionCommand.Start(
                        "other", "north", new MissionPlan.FromTemplate("nosuch", 0), null, null)));
        farm.rejects(
                ErrorCode.MISSION_EXISTS,
                () -> farm.request(new MissionCommand.Create("m", "north", new MissionPlan.Unspecified())));

        farm.request(new MissionCommand.Stop("m"));
        farm.rejects(ErrorCode.MISSION_NOT_RUNNING, () -> farm.request(new MissionCommand.Stop("m")));
        farm.hostAll();
        farm.rejects(ErrorCode.NAME_TAKEN, () -> farm.start("m", "south"));
        farm.start("other", "south", DeviceGroup.entity("urn:robot"));
    }
}
