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

/** How soon eager detection tells of a pair that has come close, fed from memory inside the job. */
public final class EagerMeasurement {
    private static final double MILLI = 1e6;

    private EagerMeasurement() {}

    /**
     * Adds a row, times in milliseconds.
     *
     * @param devices each reports once a second
     * @param bufferTimeout how long a record waits for company on its way to the next stage; 0: not at all
     */
    public static void run(
            int devices, int parallelism, Duration bufferTimeout, Duration measured, Figures figures) throws Exception {
        String name = "eager-" + parallelism + "-" + bufferTimeout.toMillis() + "-" + System.nanoTime();
        AlarmDelays delays = AlarmDelays.start(name, devices);
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        settings.set(PipelineOptions.MAX_PARALLELISM, CollisionMeasurement.MAX_PARALLELISM);
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, bufferTimeout);
        StreamExecutionEnvironment env = StreamExecutionEnvironment.createLocalEnvironment(parallelism, settings);
        CollisionDetection.define(PacedFleet.in(env, name, devices), CollisionRules.DEFAULT, true)
                .encounters()
                .sinkTo(new AlarmDelays.To(name))
                .uid("delays");
        JobClient job = env.executeAsync(name);
        TimeUnit.MILLISECONDS.sleep(measured.toMillis());
        delays.delays().reset(); // the JVM was cold
        TimeUnit.MILLISECONDS.sleep(measured.toMillis());
        Histogram found = delays.delays().copy();
        job.cancel().get(1, TimeUnit.MINUTES);
        Histogram bare = new BareLoop(devices).delays((int) Math.max(2, measured.toSeconds() / 2));
        figures.add(
                "updates/s", devices,
                "cores", parallelism,
                "buffers ms", (int) bufferTimeout.toMillis(),
                "p50 ms", found.getValueAtPercentile(50) / MILLI,
                "p99 ms", found.getValueAtPercentile(99) / MILLI,
                "max ms", found.getMaxValue() / MILLI,
                "alarms", found.getTotalCount(),
                "bare p50 ms", bare.getValueAtPercentile(50) / MILLI,
                "bare p99 ms", bare.getValueAtPercentile(99) / MILLI);
    }
}
