package io.furrow.cli.control;

import org.junit.jupiter.api.AutoClose;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.model.ngsi.NgsiJson;

import static org.assertj.core.api.Assertions.assertThat;

/** Commands on several missions, alarms or devices at once, and those that wait. */
class SeveralNamesTest {
    private static final String MISSIONS = """
            [{'mission':'a','status':{'state':'running'}}, {'mission':'b','status':{'state':'stopped'}},
             {'mission':'c','status':{'state':'created','due':1795755600000}}, {'mission':'d','status':{'state':'created'}},
             {'mission':'e','status':{'state':'starting'}}, {'mission':'f','status':{'state':'stopping'}}]""";
    private static final String CONFLICT = "{'error':'mission-not-running','reason':'mission b does not run'}";

    @AutoClose
    private final StubControl control = new StubControl();

    @Test
    void stopsTheOthersWhereOneIsRefused() {
        control.answer("POST /api/missions/a/stop", "{'status':'stopped','mission':'a'}")
                .answer("POST /api/missions/b/stop", 409, CONFLICT)
                .answer("POST /api/missions/c/stop", "{'status':'stopped','mission':'c'}");

        assertThat(control.run("mission", "stop", "a", "b", "c")).isEqualTo(1);

        assertThat(control.output().lines())
                .containsExactly(
                        "stopped: mission a", "mission b does not run (mission-not-running)", "stopped: mission c");
        assertThat(control.run("mission", "stop", "a", "c", "-o", "yaml")).isZero();
        assertThat(control.output())
                .contains("mission: \"a\"", System.lineSeparator() + "---")
                .endsWith("\"c\"\n");
    }

    @ParameterizedTest
    @CsvSource(delimiter = '|', textBlock = """
            --all          | /api/missions
            --domain=d/1   | /api/missions?domain=d%2F1
            """)
    void stopsMissionsThatRunOrAreScheduled(String which, String path) {
        control.answer("GET " + path, MISSIONS);
        for (String mission : "abcdef".split("")) {
            control.answer("POST /api/missions/%s/stop".formatted(mission), "{'mission':'%s'}".formatted(mission));
        }

        assertThat(control.run("mission", "stop", which)).isZero();

        assertThat(control.output().lines())
                .containsExactly("stopped: mission a", "stopped: mission c", "stopped: mission e");
        control.answer("GET " + path, "[]");
        control.run("mission", "stop", which); // takes the first answer away
        control.output();
        assertThat(control.run("mission", "stop", which)).isZero();
        assertThat(control.output()).startsWith("No mission").contains(" runs or is scheduled.");
    }

    @Test
    void wantsToKnowWhichMissionsToStop() {
        assertThat(control.run("mission", "stop")).isEqualTo(2);
        assertThat(control.run("mission", "stop", "a", "--all")).isEqualTo(2);
        assertThat(control.run("mission", "stop", "--all", "--domain", "d")).isEqualTo(2);
        assertThat(control.output()).contains("Name missions, or a domain with --domain, or --all.");
        assertThat(control.requested()).isEmpty();
    }

    @Test
    void sendsCommandsAboutSeveralAlarmsDevicesAndMissions() {
        control.run("alarm", "acknowledge", "x-1", "x-2");
        control.run("device", "restart", "urn:a", "urn:b", "--fiware-service", "s");
        control.run("mission", "delete", "a", "b");
        control.run("mission", "purge", "a", "b");

        assertThat(control.requested())
                .containsExactly(
                        "POST /api/alarms/x-1/acknowledge {}",
                        "POST /api/alarms/x-2/acknowledge {}",
                        "POST /api/devices/urn%3Aa/commands?service=s {\"command\":\"restart\"}",
                        "POST /api/devices/urn%3Ab/commands?service=s {\"command\":\"restart\"}",
                        "DELETE /api/missions/a",
                        "DELETE /api/missions/b",
                        "DELETE /api/recordings/a",
                        "DELETE /api/recordings/b");
    }

    @Test
    void countsWhatAPurgeWouldDelete() {
        control.answer(
                "DELETE /api/recordings/a?dryRun=true",
                "{'status':'purged','mission':'a','events':5,'markers':1,'dryRun':true}");

        assertThat(control.run("mission", "purge", "a", "--dry-run")).isZero();

        assertThat(control.output()).isEqualToIgnoringNewLines("would be deleted: mission a, events 5, markers 1");
    }

    @Test
    void waitsUntilAMissionRuns() {
        String wait = "?wait=starting&wait=running&wait=stopping&wait=stopped&wait=failed&timeout=30";
        control.answer("POST /api/missions/m/start", "{'status':'scheduled','mission':'m'}")
                .answer("GET /api/missions/m", "{'mission':'m','status':{'state':'created','since':0}}")
                .answer("GET /api/missions/m" + wait, "{'mission':'m','status':{'state':'running','since':0}}");

        assertThat(control.run("mission", "start", "m", "--wait")).isZero();

        assertThat(control.output().lines())
                .satisfiesExactly(
                        line -> assertThat(line).isEqualTo("scheduled: mission m"),
                        line -> assertThat(line).contains("created"),
                        line -> assertThat(line).contains("running"));
    }

    @Test
    void reportsWhichOfSeveralMissionsHasNotStoppedInTime() throws Exception {
        for (String mission : "ab".split("")) {
            control.answer("POST /api/missions/%s/stop".formatted(mission), "{'mission':'%s'}".formatted(mission));
        }
        control.answer("GET /api/missions/a", "{'status':{'state':'stopping'}}")
                .answer("GET /api/missions/b", "{'status':{'state':'stopped'}}");

        assertThat(control.run("mission", "stop", "a", "b", "--wait", "--timeout", "1ms"))
                .isEqualTo(1);

        assertThat(control.output())
                .containsPattern("a  .*stopping")
                .containsPattern("b  .*stopped")
                .contains("mission a is stopping, not stopped")
                .doesNotContain("mission b is");
        control.run("mission", "stop", "b", "--wait", "-o", "json");
        assertThat(NgsiJson.mapper().readTree(control.output()).path("mission").asText())
                .isEqualTo("b");
    }
}
