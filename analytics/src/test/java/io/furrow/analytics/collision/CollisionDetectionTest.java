package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.List;

import org.apache.flink.api.common.JobExecutionResult;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.metrics.Counter;
import org.apache.flink.metrics.Metric;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.runtime.testutils.MiniClusterResourceConfiguration;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.apache.flink.util.CloseableIterator;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;
import org.junit.jupiter.params.ParameterizedTest;
import org.junit.jupiter.params.provider.ValueSource;

import static org.assertj.core.api.Assertions.assertThat;

class CollisionDetectionTest {
    private static final InMemoryReporter METRICS = InMemoryReporter.createWithRetainedMetrics();

    @RegisterExtension
    static final MiniClusterExtension FLINK = new MiniClusterExtension(new MiniClusterResourceConfiguration.Builder()
            .setConfiguration(METRICS.addToConfiguration(new Configuration()))
            .setNumberSlotsPerTaskManager(4)
            .build());

    private static final int WORLDS_PER_JOB = 25;
    private static final long BOUND = 1500;
    private static final long START = 1_700_000_000_000L;
    /** A world lasts 20 s and its last position 3 s: no world sees anything of another. */
    private static final long WORLD_MILLIS = 60_000;

    @ParameterizedTest
    @ValueSource(doubles = {0.5, 5, 50, 1000})
    void agreesWithTheDefinitionAtAnyParallelism(double threshold) throws Exception {
        long seed = System.nanoTime();
        System.out.println("collision jobs for " + threshold + " m from seed " + seed);
        List<PositionFix> fixes = worlds(threshold, seed);
        CollisionRules rules = Worlds.rules(threshold, 20, false);
        List<Encounter> expected = CollisionOracle.encounters(fixes, rules);
        assertThat(expected).hasSizeGreaterThan(WORLDS_PER_JOB);
        for (int parallelism : new int[] {1, 2, 4}) {
            List<PositionFix> arrivals = new Worlds(seed + parallelism).shuffled(fixes, BOUND);
            Detected detected = detect(arrivals, rules, parallelism);
            assertThat(detected.late).isEmpty();
            assertThat(CollisionOracle.difference(detected.encounters, expected))
                    .as("parallelism %d, seed %d", parallelism, seed)
                    .isEmpty();
            assertThat(detected.violations).isZero();
            assertThat(detected.accepted).isEqualTo(fixes.size());
        }
    }

    @Test
    void givesTheSameForAnotherCellSizeAndASecondPass() throws Exception {
        List<PositionFix> fixes = worlds(5, 31);
        Detected first = detect(new Worlds(32).shuffled(fixes, BOUND), Worlds.rules(5, 1, true), 2);
        Detected second = detect(new Worlds(33).shuffled(fixes, BOUND), Worlds.rules(5, 40, true), 2);
        assertThat(first.encounters).isNotEmpty();
        assertThat(CollisionOracle.difference(first.encounters, second.encounters))
                .isEmpty();
        assertThat(first.late).isEmpty();
        assertThat(second.late).isEmpty();
    }

    @Test
    void setsLatePositionsAsideAndDetectsAmongTheRest() throws Exception {
        List<PositionFix> fixes = new ArrayList<>(List.of(
                Fixes.east("a", 0, START), Fixes.east("b", 1, START), Fixes.east("c", 1000, START + BOUND + 10)));
        PositionFix late = Fixes.east("d", 2, START);
        List<Encounter> expected = CollisionOracle.encounters(fixes, CollisionRules.DEFAULT);
        fixes.add(late);
        Detected detected = detect(fixes, CollisionRules.DEFAULT, 1);
        assertThat(detected.late).containsExactly(late);
        assertThat(detected.encounters).hasSize(2).isEqualTo(expected);
    }

    private static List<PositionFix> worlds(double threshold, long seed) {
        List<PositionFix> fixes = new ArrayList<>();
        for (int i = 0; i < WORLDS_PER_JOB; i++) {
            fixes.addAll(new Worlds(seed + i).wander(Worlds.centre(i), threshold, START + i * WORLD_MILLIS));
        }
        return fixes;
    }

    /** What came out of one job. */
    private record Detected(List<Encounter> encounters, List<PositionFix> late, long violations, long accepted) {}

    private static Detected detect(List<PositionFix> arrivals, CollisionRules rules, int parallelism) throws Exception {
        Configuration settings = new Configuration().set(PipelineOptions.GENERIC_TYPES, false);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        env.setParallelism(parallelism);
        DataStream<PositionFix> fixes = env.fromData(arrivals)
                .rebalance()
                .map(fix -> fix)
                .returns(PositionFix.class)
                .assignTimestampsAndWatermarks(
                        WatermarkStrategy.<PositionFix>forGenerator(context -> new EachEvent<>(BOUND))
                                .withTimestampAssigner((fix, previous) -> fix.time()));
        CollisionDetection detection = CollisionDetection.define(fixes, rules);
        CloseableIterator<Encounter> encounters = detection.encounters().collectAsync();
        CloseableIterator<PositionFix> late = detection.late().collectAsync();
        JobExecutionResult result = env.execute();
        List<Encounter> sorted = new ArrayList<>();
        encounters.forEachRemaining(sorted::add);
        sorted.sort(CollisionOracle.ORDER);
        List<PositionFix> all = new ArrayList<>();
        late.forEachRemaining(all::add);
        return new Detected(sorted, all, total("violations", result), total("accepted", result));
    }

    private static long total(String counter, JobExecutionResult result) {
        var metrics = METRICS.findMetrics(result.getJobID(), ".*\\." + counter);
        assertThat(metrics).isNotEmpty();
        return metrics.values().stream()
                .mapToLong(CollisionDetectionTest::count)
                .sum();
    }

    private static long count(Metric metric) {
        return ((Counter) metric).getCount();
    }
}
