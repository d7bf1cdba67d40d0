package io.furrow.control.mission;

import java.time.Duration;
import java.util.List;

import com.fasterxml.jackson.databind.node.ObjectNode;
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
import io.furrow.model.control.RejectedException;
import io.furrow.model.topic.Topics;

import static com.fasterxml.jackson.databind.node.JsonNodeFactory.instance;
import static io.furrow.control.mission.FarmFixture.group;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.assertThatThrownBy;

class MissionDevicesTest {
    private final FarmFixture farm = new FarmFixture();

    @BeforeEach
    void makeADomain() throws Exception {
        farm.domain("north");
    }

    @Test
    void publishesCarriers() throws Exception {
        DeviceGroup robots = new DeviceGroup("robots", null, "Robot", 2, null, null, true, instance.objectNode());
        DeviceGroup cameras = new DeviceGroup(null, null, "Camera", 3, "robots", null, true, instance.objectNode());
        farm.start("m", "north", cameras, robots);

        assertThat(farm.device("urn:ngsi-ld:Camera:m-1").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-1");
        assertThat(farm.device("urn:ngsi-ld:Camera:m-2").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-2");
        assertThat(farm.device("urn:ngsi-ld:Camera:m-3").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-1");
        assertThat(farm.device("urn:ngsi-ld:Robot:m-1").version().carriedBy()).isNull();
    }

    @Test
    void publishesADeviceWithAPlaceAsStationary() throws Exception {
        ObjectNode placed = instance.objectNode();
        placed.putObject("at").put("latitude", 40.3).put("longitude", -3.5);
        farm.start(
                "m",
                "north",
                new DeviceGroup(null, null, "Thermometer", 1, null, null, false, placed),
                new DeviceGroup(null, null, "Robot", 1, null, null, false, instance.objectNode()));

        assertThat(farm.device("urn:ngsi-ld:Thermometer:m-1").version().stationary())
                .isTrue();
        assertThat(farm.device("urn:ngsi-ld:Robot:m-1").version().stationary()).isFalse();
    }

    /** Devices of a group share its settings. */
    @Test
    void writesTheSettingsOfAGroupOnce() throws Exception {
        ObjectNode area = instance.objectNode().put("area", "field-1");
        area.putObject("parameters").put("mean", 18);
        farm.start(
                "m", "north", new DeviceGroup(null, null, "Thermometer", 3, null, Duration.ofSeconds(1), true, area));

        assertThat(farm.publisher.compacted(Topics.MISSION_DEVICES)).containsOnlyKeys("m.0");
        for (byte[] device : farm.publisher.compacted(Topics.DEVICES).values()) {
            assertThat(new String(device)).doesNotContain("field-1").contains("\"period\":\"PT1S\"");
        }
        assertThat(farm.settings("urn:ngsi-ld:Thermometer:m-3")).isEqualTo(area);

        farm.request(new MissionCommand.Stop("m"));
        farm.hostAll();
        farm.request(new MissionCommand.Delete("m"));
        assertThat(farm.publisher.compacted(Topics.MISSION_DEVICES)).isEmpty();
    }

    @Test
    void writesManyDevicesInSeveralTransactions() throws Exception {
        FarmFixture many = new FarmFixture(10);
        many.domain("north");
        many.start("m", "north", group("Camera", 25));

        assertThat(many.publisher.compacted(Topics.DEVICES)).hasSize(10);
        assertThat(many.status("m").devices()).isEqualTo(25);
        many.pass(FarmFixture.TIMEOUT);
        assertThat(many.status("m").state()).isEqualTo(MissionState.STARTING);
        many.step();
        assertThat(many.publisher.compacted(Topics.DEVICES)).hasSize(20);
        many.step();
        assertThat(many.publisher.compacted(Topics.DEVICES)).hasSize(25);
        assertThat(many.step()).isFalse();
        many.pass(FarmFixture.TIMEOUT - 1);
        assertThat(many.status("m").state()).isEqualTo(MissionState.STARTING);
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.RUNNING);

        many.request(new MissionCommand.Stop("m"));
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPING);
        many.step();
        many.step();
        many.hostAll();
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPED);
    }

    @Test
    void stopsAPartiallyWrittenMission() throws Exception {
        FarmFixture many = new FarmFixture(10);
        many.domain("north");
        many.start("m", "north", group("Camera", 25));
        many.request(new MissionCommand.Stop("m"));
        while (many.step()) {
            many.hostAll();
        }
        assertThat(many.status("m").state()).isEqualTo(MissionState.STOPPED);
        assertThat(many.publisher.compacted(Topics.DEVICES)).hasSize(10);
    }

    @Test
    void rejectsADeviceThatAnotherMissionIsAboutToRequest() throws Exception {
        FarmFixture many = new FarmFixture(1);
        many.domain("north");
        many.start("m", "north", group("Camera", 2), DeviceGroup.entity("urn:robot"));
        assertThatThrownBy(() -> many.start("other", "north", DeviceGroup.entity("urn:robot")))
                .isInstanceOfSatisfying(
                        RejectedException.class, e -> assertThat(e.code()).isEqualTo(ErrorCode.DEVICE_TAKEN));
    }

    @Test
    void acceptsALongListInSeveralRequests() throws Exception {
        farm.request(new MissionCommand.Create("m", "north", new MissionPlan.Unspecified()));
        farm.request(add("robots", "Robot", 2));
        farm.request(new MissionCommand.AddDevices(
                "m",
                new MissionDevices(List.of(
                        new DeviceGroup(null, null, "Camera", 2, "robots", null, true, instance.objectNode())))));
        farm.rejects(ErrorCode.WRONG_MEMBER, () -> farm.request(add("robots", "Robot", 1)));
        farm.rejects(ErrorCode.WRONG_MEMBER, () -> farm.request(add("more", "Robot", DeviceGroup.MAX)));
        farm.rejects(
                ErrorCode.UNKNOWN_MISSION,
                () -> farm.request(new MissionCommand.AddDevices("other", MissionDevices.NONE)));

        assertThat(farm.missions.get("m").deviceCount()).isEqualTo(4);
        assertThat(farm.publisher.compacted(Topics.MISSION_DEVICES)).containsOnlyKeys("m.0", "m.1");
        farm.request(new MissionCommand.Start("m", null, new MissionPlan.Unspecified(), null, null));
        assertThat(farm.device("urn:ngsi-ld:Camera:m-2").version().carriedBy()).isEqualTo("urn:ngsi-ld:Robot:m-2");
        farm.rejects(ErrorCode.MISSION_RUNNING, () -> farm.request(add("late", "Robot", 1)));
    }

    private static MissionCommand add(String name, String type, int count) {
        return new MissionCommand.AddDevices(
                "m",
                new MissionDevices(
                        List.of(new DeviceGroup(name, null, type, count, null, null, true, instance.objectNode()))));
    }

    @Test
    void rejectsDevicesBeyondTheQuota() throws Exception {
        ObjectNode large = instance.objectNode();
        large.putObject("parameters").put("note", "x".repeat(500_000));
        MissionCommand more = new MissionCommand.AddDevices(
                "m", new MissionDevices(List.of(new DeviceGroup(null, null, "Camera", 1, null, null, true, large))));
        farm.request(new MissionCommand.Create("m", "north", new MissionPlan.Unspecified()));
        for (int bytes = 0; bytes + 500_100 < Limits.MISSION_BYTES; bytes += 500_100) {
            farm.request(more);
        }
        farm.rejects(ErrorCode.TOO_LARGE, () -> farm.request(more));

        ObjectNode area = instance.objectNode().put("type", "Polygon").put("note", "x".repeat(800_000));
        area.putArray("coordinates");
        int domains = 0;
        while (domains < 100) {
            try {
                farm.request(new DomainCommand.Create("d" + domains, new DomainDetails(null, null, area, null)));
                domains++;
            } catch (RejectedException e) {
                assertThat(e.code()).isEqualTo(ErrorCode.QUOTA_EXCEEDED);
                break;
            }
        }
        assertThat(domains).isBetween(30, 40);
        farm.rejects(ErrorCode.QUOTA_EXCEEDED, () -> farm.start("big", "north", group("Camera", 10_000)));
        farm.request(new DomainCommand.Delete("d0", false));
        farm.request(new DomainCommand.Create("d0", new DomainDetails(null, null, area, null)));
        for (int i = 0; i < 20; i++) {
            farm.request(new DomainCommand.Delete("d" + i, false));
        }
        farm.start("big", "north", group("Camera", 10_000));

        area.put("more", "x".repeat(Limits.RECORD_BYTES));
        assertThatThrownBy(
                        () -> farm.request(new DomainCommand.Change("d20", new DomainDetails(null, null, area, null))))
                .hasMessageContainingAll("d20", "900000");
    }
}
