package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.HashSet;
import java.util.List;
import java.util.Set;

import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.grid.CellRules;
import io.furrow.analytics.collision.position.ArrivalOracle;
import io.furrow.analytics.collision.position.CollisionOracle;
import io.furrow.analytics.collision.position.DetectionRun;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

class EagerDetectionTest {
    private static final Logger LOG = LoggerFactory.getLogger(EagerDetectionTest.class);

    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setNumberSlotsPerTaskManager(4)
            .build());

    private static final int JOBS = 9;
    private static final int CASES_PER_JOB = 50;
    private static final long START = 1_700_000_000_000L;
    private static final long WORLD_MILLIS = 60_000;

    @Test
    void confirmsOrWithdrawsOnceWhatItTellsAtOnceAndChangesNothingExact() throws Exception {
        long seed = Long.getLong("furrow.collision.seed", System.nanoTime());
        LOG.info("eager collisions from seed {}", seed);
        int confirmed = 0;
        int withdrawn = 0;
        for (int job = 0; job < JOBS; job++) {
            double threshold = Worlds.THRESHOLDS[job % 4];
            CollisionRules rules =
                    job % 2 == 0 ? Worlds.rules(threshold, 3 + job, job > 2) : Worlds.anyRules(threshold, seed + job);
            int parallelism = new int[] {1, 2, 4}[job % 3];
            if (parallelism == 1) { // what crowds leave out of provisional records depends on the order of arrival
                rules = rules.with(new CellRules(rules.cells().meters(), CellRules.CROWD));
            }
            List<PositionFix> fixes = new ArrayList<>();
            List<Encounter> expected = new ArrayList<>();
            for (int i = 0; i < CASES_PER_JOB; i++) {
                List<PositionFix> world = new Worlds(seed + 1000L * job + i)
                        .wander(Worlds.centre(i), threshold, START + i * WORLD_MILLIS);
                fixes.addAll(world);
                expected.addAll(CollisionOracle.result(world, rules).encounters());
            }
            List<PositionFix> arrivals = new Worlds(seed + job).shuffled(fixes, DetectionRun.BOUND);
            CollisionRules given = rules;
            DetectionRun run = DetectionRun.of(
                    arrivals,
                    positions -> CollisionDetection.define(positions.keyBy(PositionFix::device), given, true),
                    parallelism);
            String which = "job %d, seed %d, %s".formatted(job, seed, rules);
            assertThat(CollisionOracle.difference(exact(run.encounters()), expected))
                    .as(which)
                    .isEmpty();
            Set<String> provisional = ids(run.encounters(), Phase.PROVISIONAL);
            if (parallelism == 1) { // else the order in which they arrive at a stage is not that of the list
                assertThat(provisional)
                        .as(which)
                        .containsExactlyInAnyOrderElementsOf(ArrivalOracle.provisional(arrivals, rules));
            }
            assertThat(run.encounters().stream()
                            .filter(encounter -> !encounter.confirms().isEmpty()))
                    .as("an encounter confirms what is told of its pair, and nothing before it")
                    .allMatch(start -> start.phase() == Phase.STARTED
                            && start.confirms().startsWith(start.pairId() + "~")
                            && latest(start.confirms()) >= start.startTime());
            List<String> resolved = new ArrayList<>();
            run.encounters().stream()
                    .map(Encounter::confirms)
                    .filter(id -> !id.isEmpty())
                    .forEach(resolved::add);
            confirmed += resolved.size();
            Set<String> taken = ids(run.encounters(), Phase.WITHDRAWN);
            withdrawn += taken.size();
            resolved.addAll(taken);
            assertThat(resolved).as(which).containsExactlyInAnyOrderElementsOf(provisional);
        }
        LOG.info("{} confirmed, {} withdrawn", confirmed, withdrawn);
        assertThat(confirmed).isGreaterThan(6 * CASES_PER_JOB);
        assertThat(withdrawn).isGreaterThan(JOBS);
    }

    /** The newer time in the id of a provisional record. */
    private static long latest(String provisional) {
        String[] parts = provisional.split("~");
        return Math.max(Long.parseLong(parts[1]), Long.parseLong(parts[2]));
    }

    private static Set<String> ids(List<Encounter> encounters, Phase phase) {
        Set<String> ids = new HashSet<>();
        for (Encounter encounter : encounters) {
            if (encounter.phase() == phase) {
                assertThat(ids.add(encounter.id()))
                        .as("one record of " + encounter)
                        .isTrue();
            }
        }
        return ids;
    }

    /** As they would be without eager records. */
    private static List<Encounter> exact(List<Encounter> all) {
        return all.stream()
                .filter(encounter -> encounter.phase() != Phase.PROVISIONAL && encounter.phase() != Phase.WITHDRAWN)
                .map(encounter -> encounter.of(
                        encounter.phase(),
                        encounter.distance(),
                        encounter.minDistance(),
                        encounter.startTime(),
                        encounter.time()))
                .toList();
    }
}
