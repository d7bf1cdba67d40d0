package io.furrow.analytics.collision.motion;

import java.util.ArrayList;
import java.util.List;
import java.util.Random;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.test.junit5.MiniClusterExtension;
import org.junit.jupiter.api.Test;
import org.junit.jupiter.api.extension.RegisterExtension;

import io.furrow.analytics.position.PositionFix;
import io.furrow.flink.TestClusters;

import static org.assertj.core.api.Assertions.assertThat;

class MotionDetectionTest {
    @RegisterExtension
    static final MiniClusterExtension FLINK = TestClusters.of(4);

    private static final int WORLDS = 30;
    private static final int MORE_THAN_ANY_TEST_FINDS = 100_000;
    private static final long BOUND = 1500;

    @Test
    void tellsTheSameInAnyOrderOfArrivalAtAnyParallelismAndForAnyCell() throws Exception {
        List<PositionFix> fixes = new ArrayList<>();
        for (int i = 0; i < WORLDS; i++) {
            fixes.addAll(new Courses(i).world(Courses.CENTRES[i % Courses.CENTRES.length], Courses.START + 60_000 * i));
        }
        List<MotionOracle.Told> defined = MotionOracle.of(fixes, Courses.rules(20));
        List<Approach> expected =
                MotionSimulationTest.sorted(MotionSimulation.approaches(fixes, Courses.rules(20), new Random(1)));
        assertThat(expected).hasSizeGreaterThan(WORLDS);
        MotionSimulationTest.agree(MotionSimulationTest.told(expected), defined, "worlds");

        for (int parallelism : new int[] {1, 2, 4}) {
            List<PositionFix> arrivals = new Courses(parallelism).shuffled(fixes, BOUND);
            assertThat(detect(arrivals, Courses.rules(10 * parallelism * parallelism), parallelism))
                    .as("parallelism %d", parallelism)
                    .isEqualTo(expected);
        }
    }

    private static List<Approach> detect(List<PositionFix> arrivals, MotionRules rules, int parallelism)
            throws Exception {
        Configuration settings = new Configuration().set(PipelineOptions.GENERIC_TYPES, false);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.getExecutionEnvironment(settings);
        env.setParallelism(parallelism);
        DataStream<PositionFix> fixes = env.fromData(arrivals)
                .rebalance()
                .map(fix -> fix)
                .returns(PositionFix.class)
                .assignTimestampsAndWatermarks(WatermarkStrategy.<PositionFix>forGenerator(context -> new Behind())
                        .withTimestampAssigner((fix, previous) -> fix.time()));
        return MotionSimulationTest.sorted(
                MotionDetection.define(fixes, rules).executeAndCollect(MORE_THAN_ANY_TEST_FINDS));
    }

    /** A watermark after every event, so that a short job has as many as a long one. */
    private static final class Behind implements WatermarkGenerator<PositionFix> {
        private long newest = Long.MIN_VALUE;

        @Override
        public void onEvent(PositionFix fix, long time, WatermarkOutput output) {
            newest = Math.max(newest, time);
            output.emitWatermark(new Watermark(newest - BOUND - 1));
        }

        @Override
        public void onPeriodicEmit(WatermarkOutput output) {}
    }
}
