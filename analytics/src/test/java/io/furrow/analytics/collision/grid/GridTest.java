package io.furrow.analytics.collision.grid;

import java.util.Arrays;
import java.util.HashSet;
import java.util.Random;
import java.util.Set;
import java.util.stream.LongStream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.CsvSource;

import io.furrow.analytics.collision.Fixes;
import io.furrow.analytics.collision.Worlds;
import io.furrow.analytics.collision.rules.CollisionRules;

import static io.furrow.analytics.collision.Worlds.rules;
import static org.assertj.core.api.Assertions.assertThat;

class GridTest {
    private final Random random = new Random(5);

    @ParameterizedTest
    @CsvSource({"0.5,1", "0.5,20", "5,1", "5,3", "5,20", "1000,1", "1000,50", "100000,1", "100000,1000"})
    void letsEveryClosePairMeetInExactlyOneCell(double threshold, double cellsPerThreshold) {
        Grid grid = new Grid(rules(threshold, cellsPerThreshold, false));
        int close = 0;
        for (int i = 0; i < 20_000; i++) {
            double[] centre = i % 2 == 0 ? Worlds.centre(i / 2) : anywhere();
            close += assertCloseTogether(grid, threshold, near(centre, threshold), near(centre, threshold));
        }
        assertThat(close).isGreaterThan(5_000);
    }

    @ParameterizedTest
    @CsvSource({"0.5,1", "5,1", "5,20", "1000,1", "1000,20"})
    void letsPairsAtEdgesOfCellsMeetInExactlyOneCell(double threshold, double cellsPerThreshold) {
        Grid grid = new Grid(rules(threshold, cellsPerThreshold, false));
        int close = 0;
        for (int i = 0; i < 2_000; i++) {
            double[] edge = onAnEdge(grid, anywhere());
            for (int ulps = -1; ulps <= 1; ulps++) {
                double[] shifted = {moved(edge[0], ulps), moved(edge[1], ulps)};
                close += assertCloseTogether(grid, threshold, shifted, edge);
                close += assertCloseTogether(grid, threshold, shifted, near(edge, threshold));
            }
        }
        assertThat(close).isGreaterThan(6_000);
    }

    @Test
    void keepsAboutATenthOfCopiesWithCellsOfTwentyThresholds() {
        Grid grid = new Grid(rules(5, 20, false));
        double[] centre = Worlds.centre(0);
        int devices = 20_000;
        long copies = 0;
        for (int i = 0; i < devices; i++) {
            double[] place = Worlds.place(centre, random.nextDouble(2000), random.nextDouble(2000));
            copies += grid.cells(place[0], place[1]).length;
        }
        assertThat((double) copies / devices).isBetween(1.05, 1.15);
    }

    /** Key groups and buckets of maps go by the hash code: cells of one column must not share one. */
    @Test
    void spreadsTheHashCodesOfNeighbouringCells() {
        Grid grid = new Grid(CollisionRules.DEFAULT);
        Set<Long> cells = new HashSet<>();
        Set<Integer> hashCodes = new HashSet<>();
        for (double latitude = 40; latitude < 40.05; latitude += 0.0008) {
            for (double longitude = -3; longitude < -2.95; longitude += 0.001) {
                long home = grid.cells(latitude, longitude)[0];
                cells.add(home);
                hashCodes.add(Long.hashCode(home));
            }
        }
        assertThat(cells).hasSizeGreaterThan(1000);
        assertThat(hashCodes).hasSizeGreaterThan(cells.size() * 99 / 100);
    }

    @Test
    void givesEveryCellAnIdOfItsOwn() {
        Grid grid = new Grid(rules(1000, 1000, false));
        Set<Long> homes = new HashSet<>();
        // 1000 km cells: 20 bands, at 9° each; 0.5° steps meet all of them.
        for (double latitude = -89.75; latitude < 90; latitude += 0.5) {
            for (double longitude = -179.75; longitude < 180; longitude += 0.5) {
                homes.add(grid.cells(latitude, longitude)[0]);
            }
        }
        assertThat(homes).hasSize(columnsOfAllBands(20));
    }

    private static int columnsOfAllBands(int bands) {
        int columns = 0;
        for (int band = 0; band < bands / 2; band++) {
            columns += 2 * Math.max(1, (int) (2 * bands * Math.sin(Math.PI * band / bands)));
        }
        return columns;
    }

    /** 1 if the two are close and therefore were checked. */
    private int assertCloseTogether(Grid grid, double threshold, double[] one, double[] other) {
        double distance = Geodesy.distance(Fixes.at("a", one[0], one[1], 0), Fixes.at("b", other[0], other[1], 0));
        if (distance > threshold) {
            return 0;
        }
        long[] ofOne = grid.cells(one[0], one[1]);
        long[] ofOther = grid.cells(other[0], other[1]);
        long encounters = LongStream.of(ofOne)
                .filter(cell -> LongStream.of(ofOther).anyMatch(each -> each == cell))
                .filter(cell -> cell == ofOne[0] || cell == ofOther[0])
                .count();
        assertThat(encounters)
                .as("%s and %s", Arrays.toString(one), Arrays.toString(other))
                .isEqualTo(1);
        assertThat(LongStream.of(ofOne).distinct().count()).isEqualTo(ofOne.length);
        return 1;
    }

    private double[] anywhere() {
        return new double[] {Math.toDegrees(Math.asin(random.nextDouble(-1, 1))), random.nextDouble(-180, 180)};
    }

    private double[] near(double[] centre, double threshold) {
        double[] place =
                Worlds.place(centre, threshold * random.nextDouble(-1, 1), threshold * random.nextDouble(-1, 1));
        return new double[] {Math.max(-90, Math.min(90, place[0])), Math.max(-180, Math.min(180, place[1]))};
    }

    /** The south-western corner of a cell as nearly as can be reported from outside, by bisection on where the home changes. */
    private double[] onAnEdge(Grid grid, double[] inside) {
        return new double[] {edge(grid, inside, 0), edge(grid, inside, 1)};
    }

    private double edge(Grid grid, double[] inside, int axis) {
        long home = grid.cells(inside[0], inside[1])[0];
        double[] probe = inside.clone();
        double in = inside[axis];
        double out = axis == 0 ? -90 : -180;
        while (in - out > Math.ulp(in)) {
            probe[axis] = (in + out) / 2;
            if (grid.cells(probe[0], probe[1])[0] == home) {
                in = probe[axis];
            } else {
                out = probe[axis];
            }
        }
        return in;
    }

    private static double moved(double value, int ulps) {
        return ulps == 0 ? value : ulps > 0 ? Math.nextUp(value) : Math.nextDown(value);
    }
}
