package io.furrow.bench.analytics.load;

import java.util.concurrent.locks.LockSupport;

import org.apache.flink.api.common.eventtime.WatermarkStrategy;
import org.apache.flink.api.common.functions.FlatMapFunction;
import org.apache.flink.api.connector.source.lib.NumberSequenceSource;
import org.apache.flink.streaming.api.datastream.DataStream;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.util.Collector;

import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.AlarmDelays;

/** The fixes of a {@link Fleet} as time goes by, one at a time: each device once a second. Stamps each in {@link AlarmDelays}. */
public final class PacedFleet implements FlatMapFunction<Long, PositionFix> {
    private static final long serialVersionUID = 1L;
    private static final long RANGE = 1L << 40;
    private static final long MILLI = 1_000_000;

    private final String run;
    private final int devices;
    private final int shares;
    private transient Fleet fleet;
    private transient AlarmDelays delays;
    private transient long begin;

    private PacedFleet(String run, int devices, int shares) {
        this.run = run;
        this.devices = devices;
        this.shares = shares;
    }

    public static DataStream<PositionFix> in(StreamExecutionEnvironment env, String run, int devices) {
        int shares = env.getParallelism();
        return env.fromSource(
                        new NumberSequenceSource(0, shares * RANGE - 1), WatermarkStrategy.noWatermarks(), "Ticks")
                .uid("ticks")
                .flatMap(new PacedFleet(run, devices, shares))
                .uid("fleet")
                .assignTimestampsAndWatermarks(
                        WatermarkStrategy.<PositionFix>forBoundedOutOfOrderness(java.time.Duration.ofSeconds(2))
                                .withTimestampAssigner((fix, previous) -> fix.time()))
                .uid("event-time");
    }

    /** A tick of a share at a time; between two fixes the thread sleeps. */
    @Override
    public void flatMap(Long number, Collector<PositionFix> out) {
        if (fleet == null) {
            fleet = new Fleet(devices, (int) (number / RANGE), shares);
            delays = AlarmDelays.of(run);
            begin = System.nanoTime();
        }
        fleet.tick(number % RANGE, fix -> {
            long due = begin + (fix.time() - Fleet.START) * MILLI;
            for (long now = System.nanoTime(); now < due; now = System.nanoTime()) {
                LockSupport.parkNanos(due - now);
            }
            delays.arrived(fix);
            out.collect(fix);
        });
    }
}
