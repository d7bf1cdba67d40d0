package io.furrow.bench.analytics;

import java.time.Duration;
import java.util.concurrent.TimeUnit;

import org.HdrHistogram.Histogram;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.ExecutionOptions;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.collision.CollisionDetection;
import io.furrow.analytics.collision.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.PacedFleet;

/** How soon eager detection reports a pair that has come close, fed from memory inside the job. */
public final class EagerMeasurement {
    private static final double MILLI = 1e6;

    private EagerMeasurement() {}

    /**
     * What is measured, and how long after as long that does not count.
     *
     * @param devices each reports once a second
     * @param bufferTimeout how long a record waits for company on its way to the next stage; 0: not at all
     * @param watermarkInterval between two watermarks, each of which brings about what the exact stages do, all at once
     */
    public record Plan(
            int devices, int parallelism, Duration bufferTimeout, Duration watermarkInterval, Duration measured) {}

    /** Adds a row, times in milliseconds. */
    public static void run(Plan plan, Figures figures) throws Exception {
        String name = "eager-" + System.nanoTime();
        AlarmDelays delays = AlarmDelays.start(name, plan.devices);
        JobClient job = start(plan, name);
        TimeUnit.MILLISECONDS.sleep(plan.measured.toMillis());
        delays.delays().reset(); // the JVM was cold
        TimeUnit.MILLISECONDS.sleep(plan.measured.toMillis());
        Histogram found = delays.delays().copy();
        job.cancel().get(1, TimeUnit.MINUTES);
        Histogram bare = new BareLoop(plan.devices).delays((int) Math.max(2, plan.measured.toSeconds() / 2));
        figures.add(
                "updates/s",
                plan.devices,
                "cores",
                plan.parallelism,
                "buffers ms",
                (int) plan.bufferTimeout.toMillis(),
                "watermarks ms",
                (int) plan.watermarkInterval.toMillis(),
                "p50 ms",
                found.getValueAtPercentile(50) / MILLI,
                "p99 ms",
                found.getValueAtPercentile(99) / MILLI,
                "max ms",
                found.getMaxValue() / MILLI,
                "alarms",
                found.getTotalCount(),
                "bare p50 ms",
                bare.getValueAtPercentile(50) / MILLI,
                "bare p99 ms",
                bare.getValueAtPercentile(99) / MILLI);
    }

    private static JobClient start(Plan plan, String name) throws Exception {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        settings.set(PipelineOptions.MAX_PARALLELISM, CollisionMeasurement.MAX_PARALLELISM);
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, plan.bufferTimeout);
        settings.set(PipelineOptions.AUTO_WATERMARK_INTERVAL, plan.watermarkInterval);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.createLocalEnvironment(plan.parallelism, settings);
        CollisionDetection.define(
                        PacedFleet.in(env, name, plan.devices).keyBy(PositionFix::device), CollisionRules.DEFAULT, true)
                .encounters()
                .sinkTo(new AlarmDelays.To(name))
                .uid("delays");
        return env.executeAsync(name);
    }
}
