package io.furrow.bench.analytics.load;

import org.apache.flink.api.common.eventtime.Watermark;
import org.apache.flink.api.common.eventtime.WatermarkGenerator;
import org.apache.flink.api.common.eventtime.WatermarkOutput;
import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.functions.FlatMapFunction;
import org.apache.flink.api.connector.source.lib.NumberSequenceSource;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.util.Collector;

import io.furrow.analytics.position.PositionFix;

/**
 * Generates the fixes of a {@link Fleet} inside the job, in each subtask those of its share of the devices, as fast as
 * they are consumed. The input encodes shares and ticks as numbers: a range of {@link #RANGE} per share, so that
 * Flink's number source gives each subtask one range.
 */
public final class MoveFleet implements FlatMapFunction<Long, PositionFix> {
    private static final long serialVersionUID = 1L;

    private static final long RANGE = 1L << 40;

    private final int devices;
    private final int shares;
    private transient Fleet fleet;

    private MoveFleet(int devices, int shares) {
        this.devices = devices;
        this.shares = shares;
    }

    /** Emits watermarks at Flink's default interval, like a job that reads a topic. */
    public static DataStream<PositionFix> in(StreamExecutionEnvironment env, int devices) {
        int shares = env.getParallelism();
        return env.fromSource(
                        new NumberSequenceSource(0, shares * RANGE - 1), WatermarkStrategy.noWatermarks(), "Ticks")
                .uid("ticks")
                .flatMap(new MoveFleet(devices, shares))
                .uid("fleet")
                .assignTimestampsAndWatermarks(WatermarkStrategy.<PositionFix>forGenerator(context -> new Periodic())
                        .withTimestampAssigner((fix, previous) -> fix.time()))
                .uid("event-time");
    }

    @Override
    public void flatMap(Long number, Collector<PositionFix> out) {
        if (fleet == null) {
            fleet = new Fleet(devices, (int) (number / RANGE), shares);
        }
        fleet.tick(number % RANGE, out::collect);
    }

    private static final class Periodic implements WatermarkGenerator<PositionFix> {
        private long newest = Long.MIN_VALUE;

        @Override
        public void onEvent(PositionFix fix, long time, WatermarkOutput output) {
            newest = time;
        }

        /** One instant behind: more fixes of the newest may follow. */
        @Override
        public void onPeriodicEmit(WatermarkOutput output) {
            if (newest != Long.MIN_VALUE) {
                output.emitWatermark(new Watermark(newest - 1));
            }
        }
    }
}
