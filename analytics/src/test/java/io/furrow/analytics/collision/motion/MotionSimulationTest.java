package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Random;

import org.junit.jupiter.api.Tag;
import org.junit.jupiter.api.Test;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.motion.Courses.rules;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.fail;

@Tag("full")
class MotionSimulationTest {
    private static final Logger LOG = LoggerFactory.getLogger(MotionSimulationTest.class);
    private static final int CASES = 600;

    @Test
    void agreesWithTheDefinitionInRandomWorlds() {
        long seed = System.nanoTime();
        LOG.info("motion worlds from seed {}", seed);
        int predicted = 0;
        int crossed = 0;
        for (int i = 0; i < CASES; i++) {
            MotionRules rules = rules(5 + i % 60);
            List<PositionFix> fixes = world(seed, i);
            List<MotionOracle.Told> expected = MotionOracle.of(fixes, rules);
            List<MotionOracle.Told> found = told(MotionSimulation.approaches(fixes, rules, new Random(seed)));
            agree(found, expected, "case " + i + " of seed " + seed);
            predicted += count(expected, Phase.PREDICTED);
            crossed += count(expected, Phase.CROSSED);
        }
        assertThat(predicted).isGreaterThan(CASES / 2);
        assertThat(crossed).isGreaterThan(CASES / 20);
    }

    /** The second of them is shown by the reports, the first is not. */
    @Test
    void keepsContactsApartThatAreLessThanAMillisecondApart() {
        long seed = 53433193976546L;
        List<PositionFix> fixes = world(seed, 337);
        List<MotionOracle.Told> expected = MotionOracle.of(fixes, rules(42));

        agree(told(MotionSimulation.approaches(fixes, rules(42), new Random(seed))), expected, "that world");
        assertThat(count(expected, Phase.CROSSED)).isOne();
    }

    @Test
    void givesTheSameForAnyCubeSizeAndOrder() {
        for (int i = 0; i < 60; i++) {
            List<PositionFix> fixes = world(17, i);
            List<Approach> small = sorted(MotionSimulation.approaches(fixes, rules(5), new Random(i)));
            assertThat(sorted(MotionSimulation.approaches(fixes, rules(77), new Random(-i))))
                    .isEqualTo(small);
            // Eight cubes for the whole Earth: no grid at all.
            assertThat(sorted(MotionSimulation.approaches(fixes, rules(1e8), new Random(i))))
                    .isEqualTo(small);
        }
    }

    static List<Approach> sorted(List<Approach> approaches) {
        List<Approach> sorted = new ArrayList<>(approaches);
        sorted.sort(Comparator.comparing(MotionOracle.Told::of, MotionOracle.ORDER));
        return sorted;
    }

    static List<MotionOracle.Told> told(List<Approach> approaches) {
        return approaches.stream()
                .map(MotionOracle.Told::of)
                .sorted(MotionOracle.ORDER)
                .toList();
    }

    /** Also where two crossings a millisecond apart stand in another order. */
    static void agree(List<MotionOracle.Told> found, List<MotionOracle.Told> expected, String where) {
        List<MotionOracle.Told> missing = new ArrayList<>(expected);
        List<MotionOracle.Told> tooMuch = new ArrayList<>();
        for (MotionOracle.Told each : found) {
            var same = missing.stream().filter(each::agreesWith).findFirst();
            if (same.isEmpty() || !missing.remove(same.get())) {
                tooMuch.add(each);
            }
        }
        if (!missing.isEmpty() || !tooMuch.isEmpty()) {
            fail("%s: missing %s, too much %s", where, missing, tooMuch);
        }
    }

    private static int count(List<MotionOracle.Told> told, Phase phase) {
        return (int) told.stream().filter(each -> each.phase() == phase).count();
    }

    private static List<PositionFix> world(long seed, int i) {
        return new Courses(seed + i).world(Courses.CENTRES[i % Courses.CENTRES.length], Courses.START);
    }
}
