package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Function;

import org.apache.flink.api.common.JobExecutionResult;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.metrics.Counter;
import org.apache.flink.runtime.testutils.InMemoryReporter;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.util.CloseableIterator;

import static org.assertj.core.api.Assertions.assertThat;

/**
 * What came out of one run of the stages on a cluster.
 *
 * @param overflows as told, in the order of the definition's
 * @param metrics of the run
 */
record DetectionRun(
        List<Encounter> encounters,
        List<PositionFix> late,
        List<CellOverflow> overflows,
        JobExecutionResult result,
        InMemoryReporter metrics) {
    /** How much later than a newer position an older one may come. */
    static final long BOUND = 1500;

    static DetectionRun of(List<PositionFix> arrivals, CollisionRules rules, int parallelism, InMemoryReporter metrics)
            throws Exception {
        return of(
                arrivals,
                fixes -> CollisionDetection.define(fixes.keyBy(PositionFix::device), rules),
                parallelism,
                metrics);
    }

    static DetectionRun of(
            List<PositionFix> arrivals,
            Function<DataStream<PositionFix>, CollisionDetection> defined,
            int parallelism,
            InMemoryReporter metrics)
            throws Exception {
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
        CollisionDetection detection = defined.apply(fixes);
        CloseableIterator<Encounter> encounters = detection.encounters().collectAsync();
        CloseableIterator<PositionFix> late = detection.late().collectAsync();
        CloseableIterator<CellOverflow> overflows = detection.overflows().collectAsync();
        JobExecutionResult result = env.execute();
        return new DetectionRun(
                all(encounters, CollisionOracle.ORDER),
                all(late, PositionFix.SEQUENCE),
                all(overflows, Comparator.comparingLong(CellOverflow::time).thenComparingLong(CellOverflow::cell)),
                result,
                metrics);
    }

    List<CollisionOracle.Overflow> toldOverflows() {
        return overflows.stream()
                .map(told -> new CollisionOracle.Overflow(told.cell(), told.time(), told.pairs(), told.pairsLeftOut()))
                .toList();
    }

    /** The sum of a counter over all subtasks. */
    long total(String counter) {
        var found = metrics.findMetrics(result.getJobID(), ".*\\." + counter);
        assertThat(found).isNotEmpty();
        return found.values().stream()
                .mapToLong(metric -> ((Counter) metric).getCount())
                .sum();
    }

    private static <T> List<T> all(CloseableIterator<T> from, Comparator<T> order) {
        List<T> all = new ArrayList<>();
        from.forEachRemaining(all::add);
        all.sort(order);
        return all;
    }
}
