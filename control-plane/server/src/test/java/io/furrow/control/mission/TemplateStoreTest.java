package io.furrow.control.mission;

import org.junit.jupiter.api.BeforeEach;
import org.junit.jupiter.api.Test;

import io.furrow.model.control.ErrorCode;
import io.furrow.model.control.MissionCommand;
import io.furrow.model.control.MissionPlan;
import io.furrow.model.control.MissionTemplate;
import io.furrow.model.topic.Topics;

import static org.assertj.core.api.Assertions.assertThat;

class TemplateStoreTest {
    private final FarmFixture farm = new FarmFixture();

    @BeforeEach
    void createADomain() throws Exception {
        farm.domain("north");
    }

    @Test
    void createsTheMissionOfTheBuiltInTemplate() throws Exception {
        farm.request(
                new MissionCommand.Start("m", "north", new MissionPlan.FromTemplate("thesis-demo", 0), null, null));

        assertThat(farm.missions.get("m").template()).isEqualTo("thesis-demo@1");
        assertThat(farm.all(farm.devices).stream()
                        .map(each -> each.device().version().id()))
                .containsExactlyInAnyOrder("""
                                urn:ngsi-ld:Camera:m-1 urn:ngsi-ld:Robot:m-1 urn:ngsi-ld:Thermometer:m-1
                                urn:ngsi-ld:Thermometer:m-2 urn:ngsi-ld:Thermometer:m-3""".split("\\s+"));
        assertThat(farm.settings("urn:ngsi-ld:Camera:m-1").path("path")).hasSize(4);
    }

    @Test
    void retainsTheDevicesOfMissionsWhoseTemplateIsDeleted() throws Exception {
        MissionTemplate one = TemplateStore.demo();
        assertThat(farm.request(new MissionCommand.SaveTemplate(one))
                        .json()
                        .path("version")
                        .asInt())
                .isEqualTo(2);
        farm.request(new MissionCommand.DeleteTemplate("thesis-demo", 2));
        farm.request(new MissionCommand.Create("m", "north", new MissionPlan.FromTemplate("thesis-demo", 0)));
        assertThat(farm.missions.get("m").template()).isEqualTo("thesis-demo@1");
        assertThat(farm.request(new MissionCommand.SaveTemplate(one))
                        .json()
                        .path("version")
                        .asInt())
                .isEqualTo(3);

        farm.request(new MissionCommand.DeleteTemplate("thesis-demo", 0));
        farm.rejects(
                ErrorCode.UNKNOWN_TEMPLATE, () -> farm.request(new MissionCommand.DeleteTemplate("thesis-demo", 0)));
        farm.run(farm.missionHandler.templates()::installBuiltIn);
        assertThat(farm.publisher.compacted(Topics.TEMPLATES)).isEmpty();
        farm.request(new MissionCommand.Start("m", null, new MissionPlan.Unspecified(), null, null));
        assertThat(farm.status("m").devices()).isEqualTo(5);
    }
}
