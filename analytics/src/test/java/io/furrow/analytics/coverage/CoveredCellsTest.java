package io.furrow.analytics.coverage;

import java.time.Duration;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.LongStream;
import java.util.stream.Stream;

import org.junit.jupiter.api.Test;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.Arguments;
import org.junit.jupiter.params.provider.MethodSource;
import org.locationtech.jts.geom.Geometry;
import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.analytics.coverage.CoverageOracle.Exact;
import io.furrow.analytics.coverage.WorkReport.Work;
import io.furrow.analytics.field.Field;
import io.furrow.analytics.field.FieldVersions;

import static org.assertj.core.api.Assertions.assertThat;
import static org.assertj.core.api.Assertions.within;

class CoveredCellsTest {
    private static final Logger LOG = LoggerFactory.getLogger(CoveredCellsTest.class);
    private static final int DRIVES = 20;
    private static final CoverageRules RULES = new CoverageRules(
            Double.NaN, 0.1, 10, Duration.ofSeconds(10), 0.5, Duration.ofSeconds(10), Duration.ofDays(7));

    static Stream<Arguments> drives() {
        long seed = Long.getLong("coverage.seed", System.nanoTime());
        LOG.info("{} drives from seed {}", DRIVES, seed);
        return LongStream.range(seed, seed + DRIVES).mapToObj(Arguments::of);
    }

    /** By exact polygons: the area within a cell's width of the border of the union, each cell by its center. */
    @ParameterizedTest
    @MethodSource("drives")
    void coversWhatTheUnionOfTheSwathsCovers(long seed) throws Exception {
        Drives drives = new Drives(seed);
        Field field = field(drives);
        CoverageOracle oracle = new CoverageOracle(field.area(), RULES);
        for (String mission : List.of("weeding", "hoeing")) {
            List<Exact> exact = oracle.swaths(drives.reports).stream()
                    .filter(swath -> swath.mission().equals(mission))
                    .toList();
            Run run = new Run(oracle.grid());
            for (Swath swath : swaths(drives)) {
                if (swath.to().mission().equals(mission) && !swath.ofRobot()) {
                    run.add(swath);
                }
            }
            int[][] expected = oracle.codes(exact);

            Geometry union = oracle.union(exact);
            double cell = oracle.grid().cell();
            double share = (double) run.covered / oracle.grid().cells();
            assertThat(share)
                    .isCloseTo(
                            union.getArea() / oracle.area().getArea(),
                            within((union.getLength() + oracle.area().getLength())
                                    * cell
                                    / oracle.area().getArea()));
            assertThat(rows(run.codes(exact))).isEqualTo(rows(expected));
            assertThat(run.covered).isEqualTo(count(expected, 1) + count(expected, 2));
            assertThat(run.overlapped).isEqualTo(count(expected, 2));
        }
    }

    /** Else the comparison would show little. */
    @Test
    void drivesCoverOverlapAndLeaveGaps() throws Exception {
        long[] counts = new long[4];
        for (long seed = 1; seed <= 3; seed++) {
            Drives drives = new Drives(seed);
            CoverageOracle oracle = new CoverageOracle(field(drives).area(), RULES);
            int[][] codes = oracle.codes(oracle.swaths(drives.reports));
            for (int code = 1; code < counts.length; code++) {
                counts[code] += count(codes, code);
            }
        }
        LOG.info("covered, overlapped and gaps: {}", Arrays.toString(counts));
        assertThat(Arrays.stream(counts).skip(1).boxed())
                .allSatisfy(count -> assertThat(count).isGreaterThan(100));
    }

    private static Field field(Drives drives) throws Exception {
        return FieldVersions.read(drives.fields.atStart()).at("f", Drives.START).orElseThrow();
    }

    /** A robot may have worked less than a cell. */
    @Test
    void hasNoLayerWhileNoCellIsCovered() throws Exception {
        FieldGrid grid = FieldGrid.of(field(new Drives(7)).area(), 0.5);

        assertThat(new CellClasses(grid).layer(100)).isNull();
    }

    /** A robot that creeps, with an implement as wide as one may be: all that it has driven is within a working width. */
    @Test
    void retainsOnlySoManySwathsOfAWay() throws Exception {
        Drives drives = new Drives(1);
        drives.reports.clear();
        for (int i = 0; i < 1000; i++) {
            drives.reports.add(
                    new WorkReport(Drives.fix("r", "weeding", i / 50.0 - 10, 0, Drives.START + i * 100), 100, Work.ON));
        }
        Run run = new Run(FieldGrid.of(field(drives).area(), 0.5));
        for (Swath swath : swaths(drives)) {
            if (!swath.ofRobot()) {
                run.add(swath);
                assertThat(run.recent).hasSizeLessThanOrEqualTo(257);
            }
        }

        assertThat(run.recent).hasSizeGreaterThan(250);
        assertThat(run.covered).isPositive();
        assertThat(run.overlapped).isZero();
    }

    /** In the order of {@link Swath#SEQUENCE}. */
    static List<Swath> swaths(Drives drives) throws Exception {
        FieldVersions fields = FieldVersions.read(drives.fields.atStart());
        SwathBuilder builder = new SwathBuilder(RULES);
        Map<String, Drive> known = new HashMap<>();
        List<Swath> swaths = new ArrayList<>();
        for (WorkReport report : drives.reports) {
            Drive before = known.getOrDefault(report.key(), Drive.NONE);
            known.put(report.key(), builder.advance(before, report, fields, new SwathBuilder.Output() {
                @Override
                public void accept(Swath swath) {
                    swaths.add(swath);
                }

                @Override
                public void reject() {
                    throw new AssertionError("there are only two missions");
                }
            }));
        }
        swaths.sort(Swath.SEQUENCE);
        return swaths;
    }

    private static String rows(int[][] codes) {
        StringBuilder text = new StringBuilder();
        for (int row = codes.length - 1; row >= 0; row--) {
            Arrays.stream(codes[row]).forEach(code -> text.append(".+#o".charAt(code)));
            text.append('\n');
        }
        return text.toString();
    }

    private static long count(int[][] codes, int code) {
        return Arrays.stream(codes)
                .flatMapToInt(Arrays::stream)
                .filter(each -> each == code)
                .count();
    }

    /** The cells of one coverage in memory. */
    private static final class Run implements CoveredCells.Tiles {
        private final FieldGrid grid;
        private final CoveredCells cells;
        private final Map<Integer, long[]> tiles = new HashMap<>();
        private List<Swath> recent = List.of();
        private long covered;
        private long overlapped;

        Run(FieldGrid grid) {
            this.grid = grid;
            this.cells = new CoveredCells(grid, this);
        }

        void add(Swath swath) throws Exception {
            CoveredCells.Added added = cells.add(swath, recent);
            covered += added.covered();
            overlapped += added.overlapped();
            recent = cells.passBefore(swath.time() - RULES.maxGap().toMillis(), added.recent());
        }

        int[][] codes(List<Exact> swaths) throws Exception {
            double width = swaths.stream().mapToDouble(Exact::width).max().orElse(0);
            CellClasses classes = cells.classes(2 * width);
            int[][] codes = new int[grid.rows()][grid.columns()];
            for (int row = 0; row < grid.rows(); row++) {
                for (int column = 0; column < grid.columns(); column++) {
                    codes[row][column] = classes.code(row, column);
                }
            }
            return codes;
        }

        @Override
        public long[] read(int tile) {
            return tiles.get(tile);
        }

        @Override
        public void write(int tile, long[] words) {
            tiles.put(tile, words);
        }
    }
}
