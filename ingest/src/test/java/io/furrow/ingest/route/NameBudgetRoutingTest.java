package io.furrow.ingest.route;

import java.time.Duration;
import java.util.Map;

import org.apache.flink.runtime.checkpoint.OperatorSubtaskState;
import org.junit.jupiter.api.Test;

import io.furrow.flink.record.TopicRecord;

import static org.assertj.core.api.Assertions.assertThat;

class NameBudgetRoutingTest extends AssignMissionFixture {
    @Test
    void limitsUnknownMissionsAndRoutesFurtherEventsToTheDomain() throws Exception {
        for (int run = 0; run < 100; run++) {
            report("robot", 100 + run, "home", "run-" + run);
        }

        assertThat(routes()).hasSize(100);
        assertThat(routes().stream().filter("home/"::equals)).hasSize(100 - (BUDGET - 1)); // the domain is new too
        assertThat(deadLetters())
                .hasSize(100 - (BUDGET - 1))
                .first()
                .satisfies(deadLetter -> assertThat(deadLetter.headers())
                        .containsAllEntriesOf(Map.of("dead-reason", "unknown-mission", "dead-stage", "routes")));
    }

    @Test
    void countsExistingTopicsAfterARestart() throws Exception {
        for (int run = 0; run < BUDGET; run++) {
            topics.add("data.home.realtime.run-" + run);
        }
        operator.setProcessingTime(1_000);

        report("robot", 100, "home", "run-3");
        report("robot", 101, "", "run-new");
        assertThat(deadLetters())
                .hasSize(2)
                .first()
                .satisfies(deadLetter -> assertThat(deadLetter.headers())
                        .containsEntry(
                                "dead-message",
                                "domain home is not known, and 20 names that are not known have topics; delete topics that are of no more"
                                        + " use, or see --other-names"));

        topics.clear();
        operator.setProcessingTime(1_000_000); // well beyond the next reading, also on a slow machine
        report("robot", 300, "home", "run-later");
        assertThat(routes()).endsWith("home/run-later");
    }

    @Test
    void countsNamesWithoutATopic() throws Exception {
        operator.close();
        create(new AssignMission.Rule(Duration.ofMillis(1000), "", ""));
        operator.open();
        exhaustBudget();

        report("robot", 500, "", "run-beyond");
        report("robot", 501, "own", "mowing");

        assertThat(routes()).endsWith("/run-19", "/", "own/mowing");
        assertThat(deadLetters())
                .extracting(deadLetter -> deadLetter.headers().get("dead-message"))
                .containsExactly(
                        "mission run-beyond is not known, and 20 names that are not known and have no topic were taken"
                                + " since the start; see --other-names");
    }

    @Test
    void ignoresTopicsThatTheControlPlaneWillDelete() throws Exception {
        domains.add(deleted("north"));
        for (int run = 0; run < BUDGET; run++) {
            missions.add(deleted("run-" + run));
            topics.add("data.north.realtime.run-" + run);
        }
        topics.add("data.north.realtime");
        operator.setProcessingTime(1_000);

        report("robot", 100, "north", "run-3");
        report("robot", 101, "own", "mowing");

        assertThat(routes()).containsExactly("north/run-3", "own/mowing");
    }

    @Test
    void acceptsNewNamesOfTheControlPlaneBeyondTheBudget() throws Exception {
        exhaustBudget();
        domains.add(managed("north", "{}"));
        missions.add(managed("weeding", "{'domain':'north'}"));
        operator.setProcessingTime(1_000);

        report("robot", 500, "north", "weeding");
        report("robot", 501, "", "weeding");
        report("robot", 502, "south", "weeding");

        assertThat(routes()).endsWith("north/weeding", "home/", "/");
    }

    @Test
    void acceptsNamesReportedBeforeARestartBeyondTheBudget() throws Exception {
        report("robot", 100, "own", "mowing");
        OperatorSubtaskState state = operator.snapshot(1, 1);
        operator.close();
        create();
        operator.initializeState(state);
        operator.open();
        exhaustBudget();

        report("robot", 500, "own", "mowing");

        assertThat(routes()).endsWith("own/mowing");
    }

    private void exhaustBudget() throws Exception {
        for (int i = 0; i < BUDGET; i++) {
            report("other", 100 + i, "", "run-" + i);
        }
    }

    private static TopicRecord deleted(String name) {
        return serviceRecord(name, null);
    }
}
