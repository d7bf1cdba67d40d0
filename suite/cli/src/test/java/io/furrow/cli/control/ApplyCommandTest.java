package io.furrow.cli.control;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.io.TempDir;

import static org.assertj.core.api.Assertions.assertThat;

class ApplyCommandTest {
    private static final String DOMAIN = "{'domain':'farm','name':'Farm','created':1,'changed':2,'sequence':3}";
    private static final String MISSION =
            "{'mission':'weeding','domain':'farm','template':'thesis-demo@1','deviceCount':1,"
                    + "'running':true,'created':1,'sequence':4,'status':{'state':'running'},'devices':[{'type':'Robot'}]}";

    @TempDir
    Path directory;

    @AutoClose
    private final StubControl control = new StubControl();

    @Test
    void createsWhatIsMissing() throws IOException {
        control.answer("POST /api/domains", 201, "{'status':'created','domain':'farm'}")
                .answer("POST /api/missions", 201, "{'status':'created','mission':'weeding'}");

        assertThat(apply("[" + DOMAIN + "," + MISSION + "]")).isZero();

        assertThat(control.output().lines()).containsExactly("created: domain farm", "created: mission weeding");
        assertThat(control.requested())
                .containsExactly(
                        "GET /api/domains/farm",
                        "POST /api/domains {\"domain\":\"farm\",\"name\":\"Farm\"}",
                        "GET /api/missions/weeding",
                        "POST /api/missions {\"mission\":\"weeding\",\"domain\":\"farm\",\"devices\":[{\"type\":\"Robot\"}]}");
    }

    @Test
    void leavesWhatIsAsDefinedAndChangesADomain() throws IOException {
        control.answer("GET /api/domains/farm", DOMAIN.replace("Farm", "Yard"))
                .answer("GET /api/missions/weeding", MISSION)
                .answer("POST /api/domains/farm", "{'status':'changed','domain':'farm'}");

        assertThat(apply("[" + DOMAIN + "," + MISSION + "]")).isZero();

        assertThat(control.output().lines()).containsExactly("changed: domain farm", "unchanged: mission weeding");
        assertThat(control.requested())
                .containsExactly(
                        "GET /api/domains/farm",
                        "POST /api/domains/farm {\"domain\":\"farm\",\"name\":\"Farm\"}",
                        "GET /api/missions/weeding");
    }

    @Test
    void rejectsAMissionWithOtherDevicesAndWhatIsNoDefinition() throws IOException {
        control.answer("GET /api/missions/weeding", MISSION.replace("Robot", "Camera"))
                .answer("POST /api/missions", 409, "{'error':'mission-exists','reason':'there is a mission already'}");

        assertThat(apply(MISSION)).isEqualTo(1);
        assertThat(control.output()).isEqualToIgnoringNewLines("there is a mission already (mission-exists)");
        for (String other : new String[] {"{'template':'t'}", "7", "{'domain':5}"}) {
            assertThat(apply(other)).isEqualTo(2);
            assertThat(control.output()).contains("is an object with a 'domain' or a 'mission'");
        }
    }

    private int apply(String json) throws IOException {
        Path file = Files.writeString(directory.resolve("farm.json"), json.replace('\'', '"'));
        return control.run("apply", file.toString());
    }
}
