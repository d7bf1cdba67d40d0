package io.furrow.control.mission;

import java.time.Duration;
import java.time.Instant;
import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;
import org.assertj.core.api.ThrowableAssert.ThrowingCallable;
import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.DeviceGroup;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.Limits;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionDevices;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.control.RefusedException;
import io.furrow.model.device.DeviceStatus.State;
import io.furrow.model.device.DeviceVersion;
import io.furrow.model.device.WantedDevice;
import io.furrow.model.topic.Topics;

import static com.fasterxml.jackson.databind.node.JsonNodeFactory.instance;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionLifeTest {
    private final Farm farm = new Farm();

    @BeforeEach
    void makeADomain() throws Exception {
        farm.domain("north");
    }

    @Test
    void goesFromStartingToStoppedAsItsDevicesComeUpAndGo() throws Exception {
        assertThat(farm.start("m", "north", Farm.group("Thermometer", 2)).json().toString())
                .isEqualTo("{\"type\":\"response\",\"status\":\"created\",\"mission\":\"m\",\"domain\":\"north\","
                        + "\"domain_topic\":\"data.north.realtime\",\"mission_topic\":\"data.north.realtime.m\"}");
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);

        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-1"), State.RUNNING);
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.report(farm.device("urn:ngsi-ld:Thermometer:m-2"), State.RUNNING);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);

        assertThat(farm.ask(new MissionCommand.Stop("m")).json().toString())
                .isEqualTo("{\"type\":\"response\",\"status\":\"deleted\",\"mission\":\"m\"}");
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
        farm.hostAll();
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    /** As the WeLASER dashboard asks: devices that are there report with the mission's name. */
    @Test
    void runsAtOnceWithoutDevicesOfItsOwn() throws Exception {
        farm.ask(new MissionCommand.Start("m", "north", new MissionPlan.Unsaid(), null, null));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        farm.ask(new MissionCommand.Stop("m"));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    @Test
    void tellsJobsToWhomADeviceBelongsFromItsStartToItsEnd() throws Exception {
        long begin = farm.now;
        farm.start("m", "north", DeviceGroup.entity("urn:robot"));
        farm.pass(500);
        farm.ask(new MissionCommand.Stop("m"));

        DeviceVersion version =
                DeviceVersion.read(farm.outbox.compacted(Topics.DEVICES).get("farm|/|urn:robot"));
        assertThat(version)
                .extracting(DeviceVersion::domain, DeviceVersion::mission, DeviceVersion::from, DeviceVersion::until)
                .containsExactly("north", "m", begin, begin + 500);
        assertThat(farm.outbox.all().stream().filter(each -> each.topic().equals(Topics.DEVICES)))
                .hasSize(2);

        farm.ask(new MissionCommand.Delete("m"));
        assertThat(farm.outbox.compacted(Topics.DEVICES)).isEmpty();
    }

    @Test
    void namesDevicesThatDidNotComeUpInTime() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 3));
        farm.report(farm.device("urn:ngsi-ld:Camera:m-1"), State.RUNNING);
        farm.report(farm.device("urn:ngsi-ld:Camera:m-2"), State.FAILED);
        farm.pass(Farm.PATIENCE - 1);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        farm.pass(1);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.RUNNING);
        assertThat(farm.status("m").missing())
                .containsExactly(
                        new MissionStatus.Missing("urn:ngsi-ld:Camera:m-2", "why"),
                        new MissionStatus.Missing("urn:ngsi-ld:Camera:m-3", null));

        farm.report(farm.device("urn:ngsi-ld:Camera:m-3"), State.RUNNING);
        assertThat(farm.status("m").missing()).hasSize(1);
        farm.report(farm.device("urn:ngsi-ld:Camera:m-1"), State.FAILED);
        assertThat(farm.status("m").missing()).contains(new MissionStatus.Missing("urn:ngsi-ld:Camera:m-1", "why"));
        assertThat(farm.status("m").confirmed()).isEqualTo(1);
    }

    @Test
    void failsWithWhatTheHostSaysWhereNoDeviceComesUp() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 2));
        farm.report(farm.device("urn:ngsi-ld:Camera:m-2"), State.FAILED);
        farm.pass(Farm.PATIENCE);

        assertThat(farm.status("m").reason())
                .isEqualTo("none of 2 devices came up within 60 s; urn:ngsi-ld:Camera:m-2: why");
    }

    @Test
    void failsWithTheReasonWhereNoDeviceComesUp() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 3));
        farm.pass(Farm.PATIENCE);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.FAILED);
        assertThat(farm.status("m").reason()).isEqualTo("none of 3 devices came up within 60 s");
        assertThat(farm.device("urn:ngsi-ld:Camera:m-1").running()).isFalse();
        assertThat(farm.missions.get("m").running()).isFalse();

        farm.start("m", "north", Farm.group("Camera", 1));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STARTING);
        assertThat(farm.status("m").reason()).isNull();
        assertThat(farm.outbox.compacted(Topics.DEVICES)).containsOnlyKeys("farm|/|urn:ngsi-ld:Camera:m-1");
    }

    @Test
    void stopsWithoutDevicesThatDoNotGo() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 1));
        farm.ask(new MissionCommand.Stop("m"));
        farm.pass(Farm.PATIENCE);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(farm.status("m").missing())
                .containsExactly(new MissionStatus.Missing("urn:ngsi-ld:Camera:m-1", null));
    }

    @Test
    void passesOverReportsOfAnEarlierSequence() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 1));
        WantedDevice earlier = farm.device("urn:ngsi-ld:Camera:m-1");
        farm.hostAll();
        farm.ask(new MissionCommand.Stop("m"));

        farm.report(earlier, State.STOPPED);
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
    }

    @Test
    void startsAtItsDateAndStopsAfterItsDuration() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        farm.ask(new MissionCommand.Start(
                "m", "north", Farm.devices(Farm.group("Camera", 1)), date, Duration.ofSeconds(5)));
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
    void doesNotStartWhereTheStartWasTakenBack() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        farm.ask(new MissionCommand.Start("m", "north", Farm.devices(Farm.group("Camera", 1)), date, null));
        farm.ask(new MissionCommand.Stop("m"));
        farm.pass(20_000);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(farm.all(farm.devices)).isEmpty();
    }

    @Test
    void failsAtItsDateWhereItsDomainIsGone() throws Exception {
        Instant date = Instant.ofEpochMilli(farm.now + 10_000);
        farm.ask(new MissionCommand.Start("m", "north", Farm.devices(), date, null));
        farm.ask(new DomainCommand.Delete("north", false));
        farm.pass(10_000);

        assertThat(farm.status("m").state()).isEqualTo(MissionState.FAILED);
        assertThat(farm.status("m").reason()).isEqualTo("at the start date: there is no domain 'north' any more");
    }

    @Test
    void refusesWhatCannotBe() throws Exception {
        farm.domain("south");
        farm.start("m", "north", Farm.group("Camera", 1), DeviceGroup.entity("urn:robot"));

        refused(ErrorCode.MISSION_RUNNING, () -> farm.start("m", "north"));
        refused(ErrorCode.UNKNOWN_MISSION, () -> farm.ask(new MissionCommand.Stop("other")));
        refused(ErrorCode.UNKNOWN_MISSION, () -> farm.ask(new MissionCommand.Delete("other")));
        refused(ErrorCode.MISSION_RUNNING, () -> farm.ask(new MissionCommand.Delete("m")));
        refused(ErrorCode.UNKNOWN_DOMAIN, () -> farm.start("other", "east"));
        refused(ErrorCode.DEVICE_TAKEN, () -> farm.start("other", "south", DeviceGroup.entity("urn:robot")));
        refused(
                ErrorCode.DEVICE_TAKEN,
                () -> farm.start(
                        "other", "south", Farm.group("Camera", 1), DeviceGroup.entity("urn:ngsi-ld:Camera:other-1")));
        refused(
                ErrorCode.UNKNOWN_TEMPLATE,
                () -> farm.ask(new MissionCommand.Start(
                        "other", "north", new MissionPlan.FromTemplate("nosuch", 0), null, null)));
        refused(
                ErrorCode.MISSION_EXISTS,
                () -> farm.ask(new MissionCommand.Create("m", "north", new MissionPlan.Unsaid())));

        farm.ask(new MissionCommand.Stop("m"));
        refused(ErrorCode.MISSION_NOT_RUNNING, () -> farm.ask(new MissionCommand.Stop("m")));
        farm.hostAll();
        refused(ErrorCode.NAME_TAKEN, () -> farm.start("m", "south"));
        farm.start("other", "south", DeviceGroup.entity("urn:robot"));
    }

    @Test
    void keepsADomainInWhichMissionsRunUnlessForced() throws Exception {
        farm.start("m", "north", Farm.group("Camera", 1));
        refused(ErrorCode.MISSIONS_RUNNING, () -> farm.ask(new DomainCommand.Delete("north", false)));

        farm.ask(new DomainCommand.Delete("north", true));
        assertThat(farm.status("m").state()).isEqualTo(MissionState.STOPPING);
        assertThat(farm.outbox.compacted(Topics.DOMAINS)).isEmpty();
        refused(ErrorCode.UNKNOWN_DOMAIN, () -> farm.ask(new DomainCommand.Delete("north", true)));
    }

    @Test
    void makesTheMissionOfTheThesisFromItsTemplate() throws Exception {
        farm.ask(new MissionCommand.Start("m", "north", new MissionPlan.FromTemplate("thesis-demo", 0), null, null));

        assertThat(farm.missions.get("m").template()).isEqualTo("thesis-demo@1");
        assertThat(farm.all(farm.devices).stream()
                        .map(each -> each.device().version().id()))
                .containsExactlyInAnyOrder(
                        "urn:ngsi-ld:Camera:m-1",
                        "urn:ngsi-ld:Robot:m-1",
                        "urn:ngsi-ld:Thermometer:m-1",
                        "urn:ngsi-ld:Thermometer:m-2",
                        "urn:ngsi-ld:Thermometer:m-3");
        assertThat(farm.settings("urn:ngsi-ld:Camera:m-1").path("path")).hasSize(4);
    }

    @Test
    void keepsVersionsOfTemplatesAndTheDevicesOfMissionsMadeFromThem() throws Exception {
        MissionTemplate one = TemplateShelf.demo();
        assertThat(farm.ask(new MissionCommand.SaveTemplate(one))
                        .json()
                        .path("version")
                        .asInt())
                .isEqualTo(2);
        farm.ask(new MissionCommand.DeleteTemplate("thesis-demo", 2));
        farm.ask(new MissionCommand.Create("m", "north", new MissionPlan.FromTemplate("thesis-demo", 0)));
        assertThat(farm.missions.get("m").template()).isEqualTo("thesis-demo@1");
        assertThat(farm.ask(new MissionCommand.SaveTemplate(one))
                        .json()
                        .path("version")
                        .asInt())
                .isEqualTo(3);

        farm.ask(new MissionCommand.DeleteTemplate("thesis-demo", 0));
        refused(ErrorCode.UNKNOWN_TEMPLATE, () -> farm.ask(new MissionCommand.DeleteTemplate("thesis-demo", 0)));
        farm.run(farm.missionDesk.templates()::stock);
        assertThat(farm.outbox.compacted(Topics.TEMPLATES)).isEmpty();
        farm.ask(new MissionCommand.Start("m", null, new MissionPlan.Unsaid(), null, null));
        assertThat(farm.status("m").devices()).isEqualTo(5);
    }

    @Test
    void saysWhatIsCarriedByWhat() throws Exception {
        DeviceGroup robots = new DeviceGroup("robots", null, "Robot", 2, null, null, instance.objectNode());
        DeviceGroup cameras = new DeviceGroup(null, null, "Camera", 3, "robots", null, instance.objectNode());
        farm.start("m", "north", cameras, robots);

        assertThat(farm.device("urn:ngsi-ld:Camera:m-1").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-1");
        assertThat(farm.device("urn:ngsi-ld:Camera:m-2").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-2");
        assertThat(farm.device("urn:ngsi-ld:Camera:m-3").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-1");
        assertThat(farm.device("urn:ngsi-ld:Robot:m-1").version().carriedBy()).isNull();
    }

    /** However many devices share an area, it is written once. */
    @Test
    void writesTheSettingsOfAGroupOnce() throws Exception {
        ObjectNode area = instance.objectNode().put("area", "field-1");
        area.putObject("parameters").put("mean", 18);
        farm.start("m", "north", new DeviceGroup(null, null, "Thermometer", 3, null, Duration.ofSeconds(1), area));

        assertThat(farm.outbox.compacted(Topics.MISSION_DEVICES)).containsOnlyKeys("m.0");
        for (byte[] device : farm.outbox.compacted(Topics.DEVICES).values()) {
            assertThat(new String(device)).doesNotContain("field-1").contains("\"period\":\"PT1S\"");
        }
        assertThat(farm.settings("urn:ngsi-ld:Thermometer:m-3")).isEqualTo(area);

        farm.ask(new MissionCommand.Stop("m"));
        farm.hostAll();
        farm.ask(new MissionCommand.Delete("m"));
        assertThat(farm.outbox.compacted(Topics.MISSION_DEVICES)).isEmpty();
    }

    @Test
    void writesManyDevicesInSeveralTransactions() throws Exception {
        Farm many = new Farm(10);
        many.domain("north");
        many.start("m", "north", Farm.group("Camera", 25));

        assertThat(many.outbox.compacted(Topics.DEVICES)).hasSize(10);
        assertThat(many.status("m").devices()).isEqualTo(25);
        many.pass(Farm.PATIENCE);
        assertThat(many.status("m").state()).isEqualTo(MissionState.STARTING);
        many.step();
        assertThat(many.outbox.compacted(Topics.DEVICES)).hasSize(20);
        many.step();
        assertThat(many.outbox.compacted(Topics.DEVICES)).hasSize(25);
        assertThat(many.step()).isFalse();
        many.pass(Farm.PATIENCE - 1);
        assertThat(many.status("m").state()).isEqualTo(MissionState.STARTING);
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.RUNNING);

        many.ask(new MissionCommand.Stop("m"));
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPING);
        many.step();
        many.step();
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    @Test
    void stopsAMissionOfWhichSomeDevicesWereNeverAskedFor() throws Exception {
        Farm many = new Farm(10);
        many.domain("north");
        many.start("m", "north", Farm.group("Camera", 25));
        many.ask(new MissionCommand.Stop("m"));
        while (many.step()) {
            many.hostAll();
        }
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(many.outbox.compacted(Topics.DEVICES)).hasSize(10);
    }

    @Test
    void givesNoDeviceAwayThatAMissionIsAboutToAskFor() throws Exception {
        Farm many = new Farm(1);
        many.domain("north");
        many.start("m", "north", Farm.group("Camera", 2), DeviceGroup.entity("urn:robot"));
        assertThatThrownBy(() -> many.start("other", "north", DeviceGroup.entity("urn:robot")))
                .isInstanceOfSatisfying(
                        RefusedException.class, e -> assertThat(e.code()).isEqualTo(ErrorCode.DEVICE_TAKEN));
    }

    @Test
    void takesALongListInSeveralRequests() throws Exception {
        farm.ask(new MissionCommand.Create("m", "north", new MissionPlan.Unsaid()));
        farm.ask(add("robots", "Robot", 2));
        farm.ask(new MissionCommand.AddDevices(
                "m",
                new MissionDevices(
                        List.of(new DeviceGroup(null, null, "Camera", 2, "robots", null, instance.objectNode())))));
        refused(ErrorCode.WRONG_MEMBER, () -> farm.ask(add("robots", "Robot", 1)));
        refused(ErrorCode.WRONG_MEMBER, () -> farm.ask(add("more", "Robot", DeviceGroup.MOST)));
        refused(ErrorCode.UNKNOWN_MISSION, () -> farm.ask(new MissionCommand.AddDevices("other", MissionDevices.NONE)));

        assertThat(farm.missions.get("m").deviceCount()).isEqualTo(4);
        assertThat(farm.outbox.compacted(Topics.MISSION_DEVICES)).containsOnlyKeys("m.0", "m.1");
        farm.ask(new MissionCommand.Start("m", null, new MissionPlan.Unsaid(), null, null));
        assertThat(farm.device("urn:ngsi-ld:Camera:m-2").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-2");
        refused(ErrorCode.MISSION_RUNNING, () -> farm.ask(add("late", "Robot", 1)));
    }

    private static MissionCommand add(String name, String type, int count) {
        return new MissionCommand.AddDevices(
                "m",
                new MissionDevices(
                        List.of(new DeviceGroup(name, null, type, count, null, null, instance.objectNode()))));
    }

    @Test
    void takesNoMoreThanThereIsRoomFor() throws Exception {
        ObjectNode large = instance.objectNode();
        large.putObject("parameters").put("note", "x".repeat(500_000));
        MissionCommand more = new MissionCommand.AddDevices(
                "m", new MissionDevices(List.of(new DeviceGroup(null, null, "Camera", 1, null, null, large))));
        farm.ask(new MissionCommand.Create("m", "north", new MissionPlan.Unsaid()));
        for (int bytes = 0; bytes + 500_100 < Limits.MISSION_BYTES; bytes += 500_100) {
            farm.ask(more);
        }
        refused(ErrorCode.TOO_LARGE, () -> farm.ask(more));

        ObjectNode area = instance.objectNode().put("type", "Polygon").put("note", "x".repeat(800_000));
        area.putArray("coordinates");
        int domains = 0;
        while (domains < 100) {
            try {
                farm.ask(new DomainCommand.Create("d" + domains, new DomainDetails(null, null, area, null)));
                domains++;
            } catch (RefusedException e) {
                assertThat(e.code()).isEqualTo(ErrorCode.QUOTA_EXCEEDED);
                break;
            }
        }
        assertThat(domains).isBetween(30, 40);
        refused(ErrorCode.QUOTA_EXCEEDED, () -> farm.start("big", "north", Farm.group("Camera", 10_000)));
        farm.ask(new DomainCommand.Delete("d0", false));
        farm.ask(new DomainCommand.Create("d0", new DomainDetails(null, null, area, null)));
        for (int i = 0; i < 20; i++) {
            farm.ask(new DomainCommand.Delete("d" + i, false));
        }
        farm.start("big", "north", Farm.group("Camera", 10_000));

        area.put("more", "x".repeat(Limits.RECORD_BYTES));
        assertThatThrownBy(() -> farm.ask(new DomainCommand.Change("d20", new DomainDetails(null, null, area, null))))
                .hasMessageContaining("d20")
                .hasMessageContaining("900000");
    }

    private void refused(ErrorCode code, ThrowingCallable what) {
        String before = farm.content();
        int written = farm.outbox.all().size();
        assertThatThrownBy(what)
                .isInstanceOfSatisfying(
                        RefusedException.class, e -> assertThat(e.code()).isEqualTo(code));
        assertThat(farm.content()).isEqualTo(before);
        assertThat(farm.outbox.all()).hasSize(written);
    }
}
