package io.furrow.analytics.collision.motion;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Random;
import java.util.Set;

import org.junit.jupiter.api.Test;

import io.furrow.analytics.collision.encounter.Phase;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.Worlds.place;
import static io.furrow.analytics.collision.motion.Courses.CENTRES;
import static io.furrow.analytics.collision.motion.Courses.START;
import static io.furrow.analytics.collision.motion.Courses.fix;
import static org.assertj.core.api.Assertions.assertThat;

/** Machines on great circles at a steady speed, stepped through in small steps, against what was notified of their reports. */
class StraightCoursesTest {
    private static final long HORIZON = 10_000;
    private static final long STEP = 10;
    private static final long LENGTH = 30_000;
    /** The straight line above the arc after 30 m/s for 10 s, and what 10 ms do to a distance at 60 m/s. */
    private static final double ERROR = 0.31;

    private static final MotionRules RULES = new MotionRules(
            new CollisionRules(5, Duration.ofSeconds(5), Duration.ZERO, Duration.ofSeconds(1), 100),
            Duration.ofMillis(HORIZON),
            true,
            31,
            Set.of());

    private final Random random = new Random(20261121);

    /** A machine that goes all its life in one direction at one speed. */
    private record Machine(
            String id, CartesianPoint start, CartesianPoint direction, double metersPerMilli, long firstReport) {
        CartesianPoint at(long elapsed) {
            double angle = metersPerMilli * elapsed / CartesianPoint.EARTH_RADIUS_METERS;
            return start.times(Math.cos(angle))
                    .plus(direction.times(CartesianPoint.EARTH_RADIUS_METERS * Math.sin(angle)));
        }

        List<PositionFix> reports(long every, boolean tells) {
            List<PositionFix> fixes = new ArrayList<>();
            for (long elapsed = firstReport; elapsed <= LENGTH; elapsed += every) {
                CartesianPoint there = at(elapsed);
                double[] place = {there.latitude(), there.longitude()};
                double speed = tells ? 1000 * metersPerMilli : Double.NaN;
                fixes.add(fix(id, place, speed, tells ? heading(elapsed) : Double.NaN, START + elapsed));
            }
            return fixes;
        }

        private double heading(long elapsed) {
            CartesianPoint there = at(elapsed);
            CartesianPoint onward = at(elapsed + 1).minus(there);
            PositionFix fix = fix(id, new double[] {there.latitude(), there.longitude()}, 0);
            double east = onward.dot(CartesianPoint.heading(fix, 90));
            double north = onward.dot(CartesianPoint.heading(fix, 0));
            return (Math.toDegrees(Math.atan2(east, north)) + 360) % 360;
        }
    }

    @Test
    void missNoEncounterWithinTheHorizonAndPredictNoOther() {
        int met = 0;
        int passed = 0;
        for (int i = 0; i < 600; i++) {
            double seconds = 2 + 18 * random.nextDouble();
            Machine a = machine("a", i, seconds);
            Machine b = machine("b", i, seconds);
            boolean tells = i % 2 == 0;
            List<PositionFix> fixes = new ArrayList<>(a.reports(1000, tells));
            fixes.addAll(b.reports(1000, tells));
            List<Approach> predictions = MotionSimulation.approaches(fixes, RULES, random).stream()
                    .filter(approach -> approach.phase() == Phase.PREDICTED)
                    .toList();
            double threshold = RULES.common().thresholds().meters();
            long near = firstWithin(threshold + ERROR, a, b);
            long first = firstWithin(threshold - ERROR, a, b);
            double closest = distance(a, b, closest(a, b));
            // Two reports of each at least, so that a course is known without being told; no grazing for seconds.
            if (near > 3000 && first >= near && first - near < 3000) {
                // The older of two reports a second apart bounds what lies ahead, and a lasting prediction is told each
                // second.
                long latest = Math.max(3000, first - HORIZON + 2000);
                assertThat(predictions)
                        .as("case %d: %s and %s meet after %d ms", i, a, b, first)
                        .anyMatch(told -> told.time() - START <= latest && told.time() - START >= first - HORIZON)
                        .anyMatch(told -> told.time() + 1000 * told.tcpa() - START >= first - STEP);
                met++;
            }
            if (closest > threshold + ERROR) {
                // Within the time that was stepped through; a closer pass may lie beyond it.
                assertThat(predictions.stream().filter(told -> told.time() + HORIZON < START + LENGTH))
                        .as("case %d: %s and %s pass at %f m", i, a, b, closest)
                        .isEmpty();
                passed++;
            }
        }
        assertThat(met).isGreaterThan(150);
        assertThat(passed).isGreaterThan(50);
    }

    @Test
    void tellHowLongItWillTakeAndHowNearItWillBe() {
        for (int i = 0; i < 300; i++) {
            double seconds = 2 + 18 * random.nextDouble();
            Machine a = machine("a", i, seconds);
            Machine b = machine("b", i, seconds);
            List<PositionFix> fixes = new ArrayList<>(a.reports(1000, true));
            fixes.addAll(b.reports(1000, true));
            long closest = closest(a, b);
            for (Approach told : MotionSimulation.approaches(fixes, RULES, random)) {
                long cpa = Math.round(told.time() - START + 1000 * told.tcpa());
                if (told.phase() == Phase.PREDICTED && closest < LENGTH && cpa <= LENGTH) {
                    assertThat(told.dcpa())
                            .isBetween(distance(a, b, cpa) - ERROR, distance(a, b, cpa) + ERROR)
                            .isLessThan(RULES.common().thresholds().meters() + ERROR);
                }
            }
        }
    }

    @Test
    void crossWhereAPassAtTwentyMetresPerSecondIsReportedOnceASecond() {
        int crossed = 0;
        for (int i = 0; i < 300; i++) {
            double[] centre = CENTRES[i % CENTRES.length];
            double phase = 5 + 10 * random.nextDouble();
            double aside = 4.9 * random.nextDouble();
            List<PositionFix> fixes = new ArrayList<>();
            for (int second = 0; second <= 10; second++) {
                // At the whole seconds the one is at least five meters past or short of the other.
                double east = 20 * (second - 5) + phase;
                fixes.add(fix("a", place(centre, east, 0), START + 1000 * second));
                fixes.add(fix("b", place(centre, 0, aside), START + 1000 * second));
            }
            List<Approach> told = MotionSimulation.approaches(fixes, RULES, random).stream()
                    .filter(approach -> approach.phase() == Phase.CROSSED)
                    .toList();
            if (Math.abs(centre[0]) < 89) {
                assertThat(told).as("case %d", i).singleElement().satisfies(approach -> {
                    assertThat(approach.dcpa()).isBetween(aside - 0.01, aside + 0.01);
                    double seconds = 5 - phase / 20;
                    assertThat(approach.time() - START)
                            .isBetween((long) (1000 * seconds) - 2, (long) (1000 * seconds) + 2);
                });
                crossed++;
            }
        }
        assertThat(crossed).isEqualTo(200);
    }

    @Test
    void doNotCrossWhereAReportShowsThemClose() {
        List<PositionFix> fixes = new ArrayList<>();
        for (int second = 0; second <= 10; second++) {
            double[] centre = CENTRES[0];
            fixes.add(fix("a", place(centre, 20 * (second - 5), 0), START + 1000 * second));
            fixes.add(fix("b", place(centre, 0, 1), START + 1000 * second));
        }
        assertThat(MotionSimulation.approaches(fixes, RULES, random))
                .isNotEmpty()
                .noneMatch(approach -> approach.phase() == Phase.CROSSED);
    }

    /** Passes near the place of the case after this many seconds, so that many meet. */
    private Machine machine(String id, int i, double seconds) {
        double[] centre = CENTRES[i % CENTRES.length];
        double speed = random.nextInt(10) == 0 ? 0 : 1 + 29 * random.nextDouble();
        double course = 2 * Math.PI * random.nextDouble();
        double east = 3 * random.nextGaussian() - speed * seconds * Math.sin(course);
        double north = 3 * random.nextGaussian() - speed * seconds * Math.cos(course);
        double[] from = place(centre, east, north);
        double[] towards = place(centre, east + 50 * Math.sin(course), north + 50 * Math.cos(course));
        CartesianPoint there = CartesianPoint.of(fix(id, from, 0));
        var way = CartesianPoint.of(fix(id, towards, 0)).minus(there).alongTheGroundAt(there);
        return new Machine(id, there, way.times(1 / way.length()), speed / 1000, random.nextInt(1000));
    }

    private static double distance(Machine a, Machine b, long elapsed) {
        return a.at(elapsed).distance(b.at(elapsed));
    }

    private static long firstWithin(double meters, Machine a, Machine b) {
        long elapsed = 0;
        while (elapsed <= LENGTH && distance(a, b, elapsed) > meters) {
            elapsed += STEP;
        }
        return elapsed > LENGTH ? -1 : elapsed;
    }

    private static long closest(Machine a, Machine b) {
        long best = 0;
        for (long elapsed = 0; elapsed <= LENGTH; elapsed += STEP) {
            best = distance(a, b, elapsed) < distance(a, b, best) ? elapsed : best;
        }
        return best;
    }
}
