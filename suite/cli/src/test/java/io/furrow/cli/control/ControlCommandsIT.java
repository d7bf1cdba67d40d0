package io.furrow.cli.control;

import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.Test;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;
import static org.awaitility.Awaitility.await;

class ControlCommandsIT extends CommandsOnControlPlane {
    @Test
    void createsChangesListsAndDeletesDomains() throws Exception {
        Path area = Files.writeString(
                directory.resolve("area.json"),
                "{\"type\":\"Polygon\",\"coordinates\":[[[-3.49,40.31],[-3.48,40.31],[-3.48,40.32],[-3.49,40.31]]]}");

        assertThat(run("domain", "create", "north", "--name", "North", "--area", area.toString()))
                .contains("created", "domain north", "data.north.realtime");
        run("domain", "change", "north", "--description", "Behind the hill", "--fields", "f-1,f-2");
        await().untilAsserted(
                        () -> assertThat(run("domain", "list")).containsPattern("north +North +Behind the hill +2 "));
        assertThat(json("domain", "show", "north").at("/area/type").asText()).isEqualTo("Polygon");
        assertThat(refused("domain", "create", "north")).contains("north", "domain-exists");
        assertThat(run("domain", "delete", "north"))
                .contains("deleted: domain north; missions deleted: none; fields ended: none");
        assertThat(refused("domain", "delete", "north")).contains("there is no domain 'north'", "unknown-domain");
        await().untilAsserted(() -> assertThat(run("audit", "--user", "ann").lines())
                .anyMatch(line -> line.matches(".*Z +ann +service.domainmanager +delete +deleted +domain north.*")));
    }

    /** One of many ways to the manager: the others are tested without a control plane. */
    @Test
    void renamesEndsAndDeletesFields() throws Exception {
        Path file = Files.writeString(
                directory.resolve("fields.geojson"),
                "{\"type\":\"FeatureCollection\",\"features\":[%s,%s]}".formatted(field("west"), field("east")));
        onKafka("fields", "import", file.toString(), "--domain", "hill");
        run("domain", "create", "hill");

        assertThat(run("fields", "rename", "west", "--name", "Behind the barn"))
                .contains("Field west is now called Behind the barn.");
        assertThat(onKafka("fields", "list")).containsPattern("west +Behind the barn +hill +\\S+ +Polygon");
        assertThat(run("fields", "end", "west", "--at", "2999-01-01T00:00:00+01:00"))
                .contains("Field west ends at 2998-12-31T23:00:00Z.");
        assertThat(run("domain", "delete", "hill")).contains("fields ended: 2 (east, west)");
        assertThat(onKafka("fields", "list")).startsWith("There are no fields.");
        assertThat(refused("fields", "end", "west")).contains("field 'west' ended at", "wrong-state");
        assertThat(refused("fields", "end", "nosuch")).contains("there is no field 'nosuch'; there are: east, west");
        assertThat(run("fields", "delete", "west")).contains("Field west is deleted, with its");
        assertThat(refused("fields", "delete", "west")).contains("unknown-field");
        assertThat(onKafka("fields", "list", "--versions")).doesNotContain("west");
    }

    private static String field(String id) {
        return "{\"type\":\"Feature\",\"id\":\"%s\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\",".formatted(id)
                + "\"coordinates\":[[[0,0],[0.01,0],[0.01,0.01],[0,0]]]}}";
    }

    @Test
    void takesAMissionThroughItsLifeAndFollowsIt() throws Exception {
        Path devices = Files.writeString(directory.resolve("devices.json"), "[\"urn:ngsi-ld:Robot:7\"]");
        run("domain", "create", "farm");

        assertThat(run("mission", "create", "weeding", "--domain", "farm", "--devices", devices.toString()))
                .contains("created: mission weeding");
        await().untilAsserted(() ->
                assertThat(run("mission", "list", "--domain", "farm")).containsPattern("weeding +farm +- +created"));
        run("mission", "start", "weeding", "--at", Long.toString(System.currentTimeMillis()));
        assertThat(run("mission", "watch", "weeding", "--until", "starting")).contains("starting", "0/1 devices");
        assertThat(run("device", "list", "--mission", "weeding")).contains("urn:ngsi-ld:Robot:7", "running");
        assertThat(refused("mission", "start", "weeding")).contains("mission-running");
        assertThat(run("mission", "stop", "weeding")).contains("stopped: mission weeding");
        assertThat(run("mission", "watch", "weeding")).contains("stopped");
        assertThat(run("mission", "delete", "weeding")).contains("deleted: mission weeding");
        assertThat(refused("mission", "stop", "weeding")).contains("there is no mission 'weeding'", "unknown-mission");
        assertThat(refused("mission", "create", "m.1", "--domain", "farm")).contains("illegal-name");
    }

    @Test
    void givesADeviceNewCredentials() throws Exception {
        Path devices = Files.writeString(directory.resolve("thermometers.json"), "[{\"type\":\"Thermometer\"}]");
        run("domain", "create", "barn");
        run("mission", "start", "drying", "--domain", "barn", "--devices", devices.toString());
        String device = "urn:ngsi-ld:Thermometer:drying-1";
        await().untilAsserted(() -> assertThat(run("device", "credentials", device))
                .contains(secret.device("drying", device).password()));

        assertThat(run("device", "rotate", device))
                .contains(
                        secret.device("drying", device, 1).user(),
                        secret.device("drying", device, 1).password());
        assertThat(json("device", "credentials", device).path("generation").asInt())
                .isEqualTo(1);
        assertThat(refused("device", "rotate", "urn:nosuch")).contains("there is no device", "unknown-device");
    }

    @Test
    void carriesATemplateOutAndBackIn() throws Exception {
        Path file = directory.resolve("template.json");
        await().untilAsserted(() -> assertThat(run("template", "list")).contains("thesis-demo"));

        run("template", "export", "thesis-demo", file.toString());
        assertThat(NgsiJson.read(Files.readAllBytes(file)).path("devices")).isNotEmpty();
        assertThat(run("template", "import", file.toString())).contains("created: template thesis-demo, version 2");
        assertThat(run("template", "delete", "thesis-demo@2")).contains("deleted: template thesis-demo");
        assertThat(refused("template", "export", "nosuch")).contains("unknown-template");
    }

    @Test
    void requestsReplaysAndSteersThem() throws Exception {
        String replay = json("replay", "start", "weeding", "--speed", "10", "--loop")
                .path("replay")
                .asText();

        assertThat(replay).matches("weeding\\.[0-9a-f]{8}");
        assertThat(run("replay", "pause", replay)).contains("paused");
        assertThat(run("replay", "step", replay, "5")).contains("paused");
        assertThat(run("replay", "speed", replay, "max")).contains(replay);
        assertThat(run("replay", "resume", replay)).contains("running");
        assertThat(refused("replay", "speed", replay, "fast")).contains("speed", "wrong-member");
        assertThat(run("replay", "stop", replay)).contains("stopped: replay " + replay);
    }
}
