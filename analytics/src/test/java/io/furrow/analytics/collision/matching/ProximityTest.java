package io.furrow.analytics.collision.matching;

import java.time.Duration;
import java.util.Random;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.grid.Geodesy;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

import static io.furrow.analytics.collision.Fixes.at;
import static io.furrow.analytics.collision.Fixes.carriedBy;
import static io.furrow.analytics.collision.Fixes.east;
import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class ProximityTest {
    @Test
    void isSymmetricToTheLastBitAndAgreesWithTheAngleBetweenVectors() {
        Random random = new Random(7);
        for (int i = 0; i < 2000; i++) {
            PositionFix a = at("a", random.nextDouble(-90, 90), random.nextDouble(-180, 180), 0);
            PositionFix b = at("b", random.nextDouble(-90, 90), random.nextDouble(-180, 180), 0);
            assertThat(Geodesy.distance(a, b)).isEqualTo(Geodesy.distance(b, a));
            assertThat(Geodesy.distance(a, b)).isCloseTo(angle(a, b) * Geodesy.EARTH_RADIUS_METERS, within(0.1));
        }
    }

    private static double angle(PositionFix a, PositionFix b) {
        CellEntry u = CellEntry.of(a, true);
        CellEntry v = CellEntry.of(b, true);
        double chord = Math.sqrt(
                Geodesy.square(u.x() - v.x()) + Geodesy.square(u.y() - v.y()) + Geodesy.square(u.z() - v.z()));
        return 2 * Math.asin(Math.min(1, chord / 2));
    }

    @ParameterizedTest
    @ValueSource(doubles = {0.1, 0.5, 5, 1000, 100_000})
    void countsTheBoundaryAndNothingBeyondIt(double about) {
        PositionFix a = at("a", 40.3, -3.4, 0);
        PositionFix b = at("b", 40.3 + Math.toDegrees(about / Geodesy.EARTH_RADIUS_METERS), -3.4, 0);
        double distance = Geodesy.distance(a, b);
        double nanometer = Math.max(1e-9, 2 * Math.ulp(distance));
        if (about > 0.1) {
            assertThat(close(a, b, distance - nanometer)).isFalse();
        }
        if (about < 100_000) {
            assertThat(close(a, b, distance + nanometer)).isTrue();
            assertThat(close(a, b, Math.max(0.1, distance))).isTrue();
        }
    }

    @ParameterizedTest
    @ValueSource(doubles = {0.1, 0.5, 5, 1000, 99_000})
    void answersAsTheHaversineFormulaDoesAroundTheThreshold(double threshold) {
        Random random = new Random(11);
        Proximity proximity = new Proximity(rules(threshold));
        int close = 0;
        for (int i = 0; i < 20_000; i++) {
            double[] centre = Worlds.centre(i);
            double angle = random.nextDouble(2 * Math.PI);
            // From far off the guard band to the last digits.
            double away = threshold * (1 + random.nextGaussian() * Math.pow(10, -random.nextInt(16)));
            double[] there = Worlds.place(centre, away * Math.cos(angle), away * Math.sin(angle));
            PositionFix a = at("a", centre[0], centre[1], 0);
            PositionFix b = at("b", Math.max(-90, Math.min(90, there[0])), there[1], 0);
            boolean expected = Geodesy.distance(a, b) <= threshold;
            assertThat(proximity.holds(CellEntry.of(a, true), CellEntry.of(b, false)))
                    .as("%s %s", a, b)
                    .isEqualTo(expected);
            close += expected ? 1 : 0;
        }
        assertThat(close).isBetween(5_000, 15_000);
    }

    @Test
    void leavesTwoHaloCopiesToTheCellWhereOneIsAtHome() {
        CellEntry a = CellEntry.of(east("a", 0, 0), false);
        CellEntry b = CellEntry.of(east("b", 1, 0), false);
        Proximity proximity = new Proximity(rules(5));
        assertThat(proximity.holds(CellEntry.of(a.fix(), true), b)).isTrue();
        assertThat(proximity.holds(a, b)).isFalse();
    }

    @Test
    void neverMatchesPartsOfOneAggregate() {
        PositionFix robot = east("robot", 0, 0);
        PositionFix camera = east("camera", 1, 0);
        PositionFix laser = carriedBy("robot", east("laser", 2, 0));
        assertThat(close(robot, camera, 5)).isTrue();
        assertThat(close(robot, carriedBy("robot", camera), 5)).isFalse();
        assertThat(close(carriedBy("robot", camera), robot, 5)).isFalse();
        assertThat(close(laser, carriedBy("robot", camera), 5)).isFalse();
        assertThat(close(laser, carriedBy("tractor", camera), 5)).isTrue();
    }

    @Test
    void dropsPairsFurtherApartInTimeThanTheGreatestSkew() {
        CollisionRules any = rules(5);
        CollisionRules second =
                new CollisionRules(5, any.timeToLive(), Duration.ofSeconds(1), any.ongoingEvery(), any.cellMeters());
        CellEntry a = CellEntry.of(east("a", 0, 0), true);
        assertThat(new Proximity(second).holds(a, CellEntry.of(east("b", 1, 1000), true)))
                .isTrue();
        assertThat(new Proximity(second).holds(a, CellEntry.of(east("b", 1, -1001), true)))
                .isFalse();
        assertThat(new Proximity(any).holds(a, CellEntry.of(east("b", 1, -1001), true)))
                .isTrue();
    }

    private static boolean close(PositionFix a, PositionFix b, double threshold) {
        return new Proximity(rules(threshold)).holds(CellEntry.of(a, true), CellEntry.of(b, true));
    }

    private static CollisionRules rules(double threshold) {
        return Worlds.rules(threshold, 20, false);
    }
}
