package io.furrow.analytics.collision;

import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.function.Function;

import org.apache.flink.api.common.JobExecutionResult;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.util.CloseableIterator;

import io.furrow.analytics.EachEvent;
import io.furrow.analytics.JobCounters;
import io.furrow.analytics.collision.encounter.Encounter;
import io.furrow.analytics.collision.matching.CellOverflow;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;

/**
 * What came out of one run of the stages on a cluster.
 *
 * @param overflows as told, in the order of the definition's
 */
public record DetectionRun(
        List<Encounter> encounters, List<PositionFix> late, List<CellOverflow> overflows, JobExecutionResult result) {
    /** How much later than a newer position an older one may come. */
    public static final long BOUND = 1500;

    public static DetectionRun of(List<PositionFix> arrivals, CollisionRules rules, int parallelism) throws Exception {
        return of(arrivals, fixes -> CollisionDetection.define(fixes.keyBy(PositionFix::device), rules), parallelism);
    }

    public static DetectionRun of(
            List<PositionFix> arrivals, Function<DataStream<PositionFix>, CollisionDetection> defined, int parallelism)
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
                result);
    }

    public List<CollisionOracle.Overflow> toldOverflows() {
        return overflows.stream().map(CollisionOracle.Overflow::of).toList();
    }

    /** The sum of a counter over all subtasks. */
    public long total(String counter) {
        return JobCounters.total(result.getJobID(), counter);
    }

    private static <T> List<T> all(CloseableIterator<T> from, Comparator<T> order) {
        List<T> all = new ArrayList<>();
        from.forEachRemaining(all::add);
        all.sort(order);
        return all;
    }
}
