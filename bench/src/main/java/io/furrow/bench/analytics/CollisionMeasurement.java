package io.furrow.bench.analytics;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.concurrent.CompletableFuture;
import java.util.concurrent.ExecutionException;
import java.util.concurrent.TimeUnit;
import java.util.stream.Stream;

import org.apache.flink.configuration.CheckpointingOptions;
import org.apache.flink.configuration.Configuration;
import org.apache.flink.configuration.ExecutionOptions;
import org.apache.flink.configuration.MemorySize;
import org.apache.flink.configuration.PipelineOptions;
import org.apache.flink.configuration.TaskManagerOptions;
import org.apache.flink.core.execution.JobClient;
import org.apache.flink.core.execution.SavepointFormatType;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;

import io.furrow.analytics.collision.CollisionDetection;
import io.furrow.analytics.collision.rules.CollisionRules;
import io.furrow.analytics.position.PositionFix;
import io.furrow.bench.analytics.load.MoveFleet;
import io.furrow.bench.frame.CpuReading;

/** Runs the three stages of collision detection in a Flink cluster of this JVM, fed from memory inside the job. */
final class CollisionMeasurement {
    private static final Duration BUFFER_TIMEOUT = Duration.ofMillis(5);
    static final int MAX_PARALLELISM = 720;
    /** In the first second everything starts at once; a few more are enough to decide whether the stages agree. */
    private static final int MAX_COMPARED = 20;

    private final Path directory;

    /** @param directory for savepoints, whose size is measured and which stay there */
    CollisionMeasurement(Path directory) {
        this.directory = directory;
    }

    CollisionReport.Run run(CollisionReport.Plan plan) throws Exception {
        String name = "collision-" + plan.devices() + "-" + plan.parallelism() + "-" + System.nanoTime();
        Progress progress = Progress.start(name, plan.parallelism());
        JobClient job = start(plan, name);
        TimeUnit.MILLISECONDS.sleep(plan.warmUp().toMillis());
        Reading before = Reading.now(progress);
        TimeUnit.MILLISECONDS.sleep(plan.measured().toMillis());
        Reading after = Reading.now(progress);
        CompletableFuture<?> ended = job.getJobExecutionResult();
        if (ended.isDone()) {
            ended.get(); // throws why
        }
        double bytes = savepointBytes(job, name);
        job.cancel().get(1, TimeUnit.MINUTES);
        Bare bare = bare(plan, progress);
        double updates = (after.eventMillis - before.eventMillis) / 1000.0 * plan.devices();
        return new CollisionReport.Run(
                plan,
                updates / after.cpu.seconds(before.cpu),
                after.cpu.cpuSeconds(before.cpu) * 1e6 / updates,
                (after.records - before.records) / updates,
                bytes / plan.devices(),
                bare.perSecond,
                RedisGeo.isInstalled()
                        ? RedisGeo.measure(plan.devices(), plan.measured().dividedBy(4))
                        : null,
                bare.compared,
                bare.different);
    }

    /** A sample of a run's progress. */
    private record Reading(CpuReading cpu, long eventMillis, long records) {
        static Reading now(Progress progress) {
            return new Reading(CpuReading.now(), progress.millis(), progress.records());
        }
    }

    private JobClient start(CollisionReport.Plan plan, String name) throws Exception {
        StreamExecutionEnvironment env =
                StreamExecutionEnvironment.createLocalEnvironment(plan.parallelism(), settings());
        CollisionDetection.define(MoveFleet.in(env, plan.devices()).keyBy(PositionFix::device), CollisionRules.DEFAULT)
                .encounters()
                .sinkTo(new Progress.Counter(name))
                .uid("count");
        return env.executeAsync(name);
    }

    private Configuration settings() {
        Configuration settings = new Configuration();
        settings.set(PipelineOptions.GENERIC_TYPES, false);
        settings.set(PipelineOptions.OBJECT_REUSE, true);
        settings.set(PipelineOptions.MAX_PARALLELISM, MAX_PARALLELISM);
        settings.set(ExecutionOptions.BUFFER_TIMEOUT, BUFFER_TIMEOUT);
        settings.set(CheckpointingOptions.CHECKPOINT_STORAGE, "filesystem");
        settings.set(
                CheckpointingOptions.CHECKPOINTS_DIRECTORY, directory.toUri().toString());
        settings.set(TaskManagerOptions.NETWORK_MEMORY_MIN, MemorySize.ofMebiBytes(64));
        settings.set(TaskManagerOptions.NETWORK_MEMORY_MAX, MemorySize.ofMebiBytes(64));
        return settings;
    }

    private double savepointBytes(JobClient job, String name)
            throws IOException, InterruptedException, ExecutionException {
        Path savepoint = Files.createDirectories(directory.resolve(name));
        job.triggerSavepoint(savepoint.toUri().toString(), SavepointFormatType.NATIVE)
                .get();
        try (Stream<Path> files = Files.walk(savepoint)) {
            return files.filter(Files::isRegularFile)
                    .mapToLong(file -> file.toFile().length())
                    .sum();
        }
    }

    /** The rate of the bare loop over the same seconds, and the number of seconds with different results. */
    private record Bare(double perSecond, int compared, int different) {}

    private static Bare bare(CollisionReport.Plan plan, Progress progress) {
        BaselineLoop loop = new BaselineLoop(plan.devices());
        int complete = (int) Math.min(MAX_COMPARED, progress.millis() / 1000 - 1);
        int different = 0;
        long second = 0;
        for (; second < complete; second++) {
            different += loop.second(second) == progress.starts(second) ? 0 : 1;
        }
        long start = System.nanoTime();
        long from = second;
        while (System.nanoTime() - start < plan.measured().toNanos() / 4) {
            loop.second(second++);
        }
        double seconds = (System.nanoTime() - start) / 1e9;
        return new Bare((second - from) * plan.devices() / seconds, Math.max(0, complete), different);
    }
}
