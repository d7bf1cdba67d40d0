package io.furrow.control.mission;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.CommandResult;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

import static io.furrow.control.mission.FarmFixture.group;
import static org.assertj.core.api.Assertions.assertThat;

class DomainDeletionTest {
    private final FarmFixture farm = new FarmFixture();

    @BeforeEach
    void createADomain() throws Exception {
        farm.domain("north");
    }

    @Test
    void rejectsDeletingADomainWithRunningMissionsUnlessForced() throws Exception {
        farm.start("m", "north", group("Camera", 1));
        farm.rejects(ErrorCode.MISSIONS_RUNNING, () -> farm.request(new DomainCommand.Delete("north", false)));

        farm.request(new DomainCommand.Delete("north", true));
        assertThat(farm.publisher.compacted(Topics.DOMAINS)).isEmpty();
        farm.rejects(ErrorCode.UNKNOWN_DOMAIN, () -> farm.request(new DomainCommand.Delete("north", true)));
    }

    @Test
    void deletesADomainWithItsMissionsAndEndsItsFields() throws Exception {
        farm.domain("south");
        farm.start("runs", "north", group("Camera", 1));
        farm.request(new MissionCommand.Create("idle", "north", new MissionPlan.Unspecified()));
        farm.start("theirs", "south", group("Camera", 1));
        farm.field("a", 1, "north");
        farm.field("b", 1, "south");
        farm.field("planned", farm.now + 1, "north");

        CommandResult answer = farm.request(new DomainCommand.Delete("north", true));

        assertThat(new String(NgsiJson.write(answer.json())))
                .isEqualTo("{\"type\":\"response\",\"status\":\"deleted\",\"domain\":\"north\",\"missionCount\":2,"
                        + "\"missions\":[\"idle\",\"runs\"],\"stopped\":[\"runs\"],\"fieldCount\":2,"
                        + "\"fields\":[\"a\",\"planned\"]}");
        assertThat(farm.all(farm.missions)).extracting(Mission::mission).containsExactly("theirs");
        assertThat(farm.all(farm.statuses)).extracting(MissionStatus::mission).containsExactly("theirs");
        assertThat(farm.publisher.compacted(Topics.MISSIONS)).containsOnlyKeys("theirs");
        assertThat(farm.publisher.compacted(Topics.MISSIONS_STATUS)).containsOnlyKeys("theirs");
        assertThat(farm.publisher.compacted(Topics.DEVICES)).containsOnlyKeys("farm|/|urn:ngsi-ld:Camera:theirs-1");
        assertThat(farm.publisher.compacted(Topics.FIELDS)).hasSize(1);
        FieldVersion end = FieldVersion.read(
                farm.publisher.compacted(Topics.FIELDS).values().iterator().next());
        assertThat(end.key()).isEqualTo(new FieldVersion.Key("a", farm.now).toString());
        assertThat(end.isEnd()).isTrue();
        farm.domain("north");
        farm.start("runs", "north", group("Camera", 1));
    }
}
