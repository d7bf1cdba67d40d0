package io.furrow.analytics.collision;

import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

import static org.assertj.core.api.Assertions.assertThat;

@Tag("full")
class CollisionSimulationTest {
    private static final Logger LOG = LoggerFactory.getLogger(CollisionSimulationTest.class);
    private static final int CASES = 1000;

    @Test
    void agreesWithTheDefinitionInRandomWorlds() {
        long seed = System.nanoTime();
        LOG.info("collision worlds from seed {}", seed);
        int transitions = 0;
        for (int i = 0; i < CASES; i++) {
            CollisionRules rules = rules(i, 2 + i % 30);
            List<PositionFix> fixes = world(seed, i);
            List<Encounter> expected = CollisionOracle.encounters(fixes, rules);
            List<Encounter> found = Simulation.encounters(fixes, rules, new Random(seed));
            assertThat(CollisionOracle.difference(found, expected))
                    .as("case %d of seed %d", i, seed)
                    .isEmpty();
            transitions += expected.size();
        }
        assertThat(transitions).as("something was compared").isGreaterThan(CASES);
    }

    @Test
    void agreesWithTheDefinitionUnderAnyRules() {
        long seed = System.nanoTime();
        LOG.info("collision worlds under any rules from seed {}", seed);
        int transitions = 0;
        int overflows = 0;
        for (int i = 0; i < CASES; i++) {
            CollisionRules rules = Worlds.anyRules(Worlds.THRESHOLDS[i % 4], seed + i);
            List<PositionFix> fixes = world(seed, i);
            CollisionOracle.Result expected = CollisionOracle.result(fixes, rules);
            CollisionOracle.Result found = Simulation.result(fixes, rules, new Random(seed));
            assertThat(CollisionOracle.difference(found.encounters(), expected.encounters()))
                    .as("case %d of seed %d", i, seed)
                    .isEmpty();
            assertThat(CollisionOracle.difference(found.overflows(), expected.overflows()))
                    .as("overflows of case %d of seed %d", i, seed)
                    .isEmpty();
            transitions += expected.encounters().size();
            overflows += expected.overflows().size();
        }
        assertThat(transitions).as("something was compared").isGreaterThan(CASES);
        assertThat(overflows).as("something was left out").isGreaterThan(CASES / 20);
    }

    @Test
    void givesTheSameForAnyCellSize() {
        for (int i = 0; i < 60; i++) {
            List<PositionFix> fixes = world(17, i);
            List<Encounter> small = Simulation.encounters(fixes, rules(i, 1), new Random(i));
            assertThat(Simulation.encounters(fixes, rules(i, 25), new Random(-i)))
                    .isEqualTo(small);
            // One cell for the whole Earth: no grid at all.
            assertThat(Simulation.encounters(fixes, rules(i, 1e9), new Random(i)))
                    .isEqualTo(small);
        }
    }

    @Test
    void startsAndEndsTheSameWhateverTheRateOfOngoingRecords() {
        for (int i = 0; i < 60; i++) {
            List<PositionFix> fixes = world(23, i);
            CollisionRules rare = rules(i, 20);
            CollisionRules all = new CollisionRules(
                    rare.thresholdMeters(),
                    rare.timeToLive(),
                    rare.maxSkew(),
                    java.time.Duration.ZERO,
                    rare.cellMeters());
            List<Encounter> every = Simulation.encounters(fixes, all, new Random(i));
            List<Encounter> some = Simulation.encounters(fixes, rare, new Random(i));
            assertThat(every).hasSizeGreaterThanOrEqualTo(some.size()).containsAll(transitions(some));
            assertThat(transitions(every)).isEqualTo(transitions(some));
        }
    }

    @Test
    void turnsWithTheEarth() {
        for (int i = 0; i < 60; i++) {
            List<PositionFix> fixes = world(29, i);
            CollisionRules rules = rules(i, 20);
            double angle = 90 + i;
            List<PositionFix> turned = fixes.stream()
                    .map(fix -> Fixes.turned(fix, Worlds.wrapped(fix.longitude() + angle)))
                    .toList();
            assertThat(Simulation.encounters(turned, rules, new Random(i)).stream()
                            .map(CollisionSimulationTest::withoutPlace))
                    .isEqualTo(Simulation.encounters(fixes, rules, new Random(i)).stream()
                            .map(CollisionSimulationTest::withoutPlace)
                            .toList());
        }
    }

    private static String withoutPlace(Encounter encounter) {
        return encounter.phase() + " " + encounter.id() + " " + encounter.time();
    }

    private static List<Encounter> transitions(List<Encounter> encounters) {
        return encounters.stream()
                .filter(encounter -> encounter.phase() != Phase.ONGOING)
                .toList();
    }

    private static CollisionRules rules(int i, double cellsPerThreshold) {
        return Worlds.rules(Worlds.THRESHOLDS[i % 4], cellsPerThreshold, i % 5 == 0);
    }

    private static List<PositionFix> world(long seed, int i) {
        return new Worlds(seed + i).wander(Worlds.centre(i / 4), Worlds.THRESHOLDS[i % 4], 1_700_000_000_000L);
    }
}
