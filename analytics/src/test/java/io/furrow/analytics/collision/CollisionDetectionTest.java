package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.JobCounters;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.rules.CellRules;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.TestClusters;

import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;

/**
 * The stages on a cluster against the definition. More cases than in a build: {@code ./furrow soak collision-cases}, which
 * sets {@code furrow.collision.cases}, and {@code furrow.collision.seed} to see a failure again.
 */
class CollisionDetectionTest {
    private static final Logger LOG = LoggerFactory.getLogger(CollisionDetectionTest.class);

    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(4, JobCounters.kept());

    private static final int CASES_PER_JOB = 100;
    private static final long START = 1_700_000_000_000L;
    /** A world lasts 20 s, its last position 3 s and a dwell 2 s: no world sees anything of another. */
    private static final long WORLD_MILLIS = 60_000;

    @Test
    void agreesWithTheDefinitionAtAnyParallelism() throws Exception {
        compareWithTheDefinition(300, 30);
    }

    @Tag("full")
    @Test
    void agreesWithTheDefinitionInManyCases() throws Exception {
        compareWithTheDefinition(Integer.getInteger("furrow.collision.cases", 1000), CASES_PER_JOB);
    }

    private static void compareWithTheDefinition(int cases, int perJob) throws Exception {
        long seed = Long.getLong("furrow.collision.seed", System.nanoTime());
        LOG.info("{} cases of collisions on a cluster from seed {}", cases, seed);
        int records = 0;
        int overflows = 0;
        for (int job = 0; job * perJob < cases; job++) {
            CollisionOracle.Result expected = assertAgreement(job, perJob, seed + 1000L * job);
            records += expected.encounters().size();
            overflows += expected.overflows().size();
        }
        LOG.info("{} records of encounters, {} of crowded cells, no difference", records, overflows);
        assertThat(records).as("something was compared").isGreaterThan(cases);
        assertThat(overflows).as("something was left out").isGreaterThanOrEqualTo(Math.max(1, cases / 1000 * 10));
    }

    /** Four jobs of ten have one threshold and nothing else; the others any rules, the last with a limit at least. */
    private static CollisionOracle.Result assertAgreement(int job, int cases, long seed) throws Exception {
        double threshold = Worlds.THRESHOLDS[job % 4];
        CollisionRules rules =
                job % 10 < 4 ? Worlds.rules(threshold, 20, job % 20 > 10) : Worlds.anyRules(threshold, seed);
        if (job % 10 == 9) {
            rules = rules.with(new CellRules(rules.cells().meters(), 1 + job / 10 % 3));
        }
        List<PositionFix> fixes = new ArrayList<>();
        List<Encounter> encounters = new ArrayList<>();
        List<CollisionOracle.Overflow> overflows = new ArrayList<>();
        for (int i = 0; i < cases; i++) {
            List<PositionFix> world = world(threshold, seed, i);
            CollisionOracle.Result expected = CollisionOracle.result(world, rules);
            fixes.addAll(world);
            encounters.addAll(expected.encounters());
            overflows.addAll(expected.overflows());
        }
        overflows.sort(CollisionOracle.Overflow.ORDER); // a cell may be notified of when the next world is there
        for (int parallelism : new int[] {1, 2, 4}) {
            List<PositionFix> arrivals = new Worlds(seed + parallelism).shuffled(fixes, DetectionRun.BOUND);
            DetectionRun run = DetectionRun.of(arrivals, rules, parallelism);
            String which = "job %d, parallelism %d, seed %d, %s".formatted(job, parallelism, seed, rules);
            assertThat(run.late()).as(which).isEmpty();
            assertThat(CollisionOracle.difference(run.encounters(), encounters))
                    .as(which)
                    .isEmpty();
            assertThat(CollisionOracle.difference(run.toldOverflows(), overflows))
                    .as(which)
                    .isEmpty();
            assertThat(run.total("violations")).as(which).isZero();
            assertThat(run.total("accepted")).as(which).isEqualTo(fixes.size());
        }
        return new CollisionOracle.Result(encounters, overflows);
    }

    @Tag("full")
    @Test
    void givesTheSameForAnotherCellSizeAndASecondPass() throws Exception {
        List<PositionFix> fixes = worlds(5, 31);
        DetectionRun first = run(new Worlds(32).shuffled(fixes, DetectionRun.BOUND), Worlds.rules(5, 1, true), 2);
        DetectionRun second = run(new Worlds(33).shuffled(fixes, DetectionRun.BOUND), Worlds.rules(5, 40, true), 2);
        assertThat(first.encounters()).isNotEmpty();
        assertThat(CollisionOracle.difference(first.encounters(), second.encounters()))
                .isEmpty();
        assertThat(first.late()).isEmpty();
        assertThat(second.late()).isEmpty();
    }

    @Test
    void setsLatePositionsAsideAndDetectsAmongTheRest() throws Exception {
        List<PositionFix> fixes = new ArrayList<>(
                List.of(east("a", 0, START), east("b", 1, START), east("c", 1000, START + DetectionRun.BOUND + 10)));
        PositionFix late = east("d", 2, START);
        List<Encounter> expected = CollisionOracle.encounters(fixes, CollisionRules.DEFAULT);
        fixes.add(late);
        DetectionRun run = run(fixes, CollisionRules.DEFAULT, 1);
        assertThat(run.late()).containsExactly(late);
        assertThat(run.encounters()).hasSize(2).isEqualTo(expected);
    }

    /** Five in a row, a meter apart: each has four others, of which it follows the nearest 3² / 4. */
    @Test
    void reportsAndCountsThePairsThatACrowdLeavesOut() throws Exception {
        List<PositionFix> fixes = new ArrayList<>();
        for (String device : List.of("a", "b", "c", "d", "e")) {
            fixes.add(east(device, device.charAt(0) - 'a', START));
        }
        CollisionRules rules = CollisionRules.DEFAULT.with(new CellRules(100, 3));

        DetectionRun run = run(fixes, rules, 1);

        assertThat(run.encounters())
                .filteredOn(encounter -> encounter.phase() == Phase.STARTED)
                .extracting(
                        encounter -> encounter.first().id() + encounter.second().id())
                .containsExactly("ab", "ac", "bc", "cd", "ce", "de");
        assertThat(run.encounters())
                .filteredOn(encounter -> encounter.phase() == Phase.ENDED)
                .hasSize(6);
        assertThat(run.overflows())
                .extracting(
                        CellOverflow::time,
                        CellOverflow::devices,
                        CellOverflow::pairs,
                        CellOverflow::pairsLeftOut,
                        CellOverflow::nearest)
                .containsExactly(
                        org.assertj.core.groups.Tuple.tuple(START, 5, 10L, 4L, 2),
                        org.assertj.core.groups.Tuple.tuple(START + 60_000, 0, 0L, 0L, 0));
        assertThat(run.total("pairsLeftOut")).isEqualTo(4);
        CellOverflow told = run.overflows().get(0);
        PositionFix center = Fixes.at("", told.latitude(), told.longitude(), 0);
        assertThat(Geodesy.distance(center, fixes.get(0))).isLessThan(100);
    }

    private static DetectionRun run(List<PositionFix> arrivals, CollisionRules rules, int parallelism)
            throws Exception {
        return DetectionRun.of(arrivals, rules, parallelism);
    }

    private static List<PositionFix> worlds(double threshold, long seed) {
        List<PositionFix> fixes = new ArrayList<>();
        for (int i = 0; i < 25; i++) {
            fixes.addAll(world(threshold, seed, i));
        }
        return fixes;
    }

    private static List<PositionFix> world(double threshold, long seed, int i) {
        return new Worlds(seed + i).wander(Worlds.centre(i), threshold, START + i * WORLD_MILLIS);
    }
}
