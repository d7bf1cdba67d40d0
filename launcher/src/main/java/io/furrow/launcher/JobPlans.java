package io.furrow.launcher;

import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.presence.PresenceJob;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureJob;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.flink.JobCommandLine;
import io.furrow.flink.JobOptions;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.ingest.normalise.NormaliseJob;
import io.furrow.ingest.normalise.NormaliseOptions;
import io.furrow.replay.ReplayJob;
import io.furrow.replay.ReplayOptions;

/** The jobs of a suite, set up with the same words that one would say to {@code flink run}. */
final class JobPlans {
    private static final String CHECKPOINT_INTERVAL = "5s";

    private final SuiteSettings settings;
    private final KafkaAccess kafka;
    private final String mongo;
    private final RunDirectory directory;

    JobPlans(SuiteSettings settings, KafkaAccess kafka, String mongo, RunDirectory directory) {
        this.settings = settings;
        this.kafka = kafka;
        this.mongo = mongo;
        this.directory = directory;
    }

    /**
     * By name.
     *
     * @throws SuiteNotStartedException if a job refuses its options, in the job's own words
     */
    Map<String, StreamExecutionEnvironment> all() {
        try {
            return assembled();
        } catch (ParameterException e) {
            throw new SuiteNotStartedException(e.getMessage(), e);
        }
    }

    private Map<String, StreamExecutionEnvironment> assembled() {
        Map<String, StreamExecutionEnvironment> plans = new LinkedHashMap<>();
        plans.put(
                "ingest",
                IngestJob.assemble(parsed(
                        "ingest",
                        new IngestOptions(),
                        "--images",
                        directory.resolve("images").toString(),
                        "--mongo",
                        mongo)));
        plans.put("normalise", NormaliseJob.assemble(parsed("normalise", new NormaliseOptions())));
        plans.put(
                "temperature",
                TemperatureJob.assemble(
                        parsed("temperature", new TemperatureOptions(), "--window", settings.window())));
        plans.put(
                "collision",
                CollisionJob.assemble(parsed(
                        "collision",
                        new CollisionOptions(),
                        "--horizon",
                        settings.watch().horizon())));
        plans.put("presence", PresenceJob.assemble(parsed("presence", new PresenceOptions())));
        plans.put("replay", ReplayJob.assemble(parsed("replay", new ReplayOptions(), "--mongo", mongo)));
        return plans;
    }

    private <T extends JobOptions> T parsed(String name, T options, String... own) {
        List<String> args = new ArrayList<>(List.of(own));
        args.addAll(List.of("--bootstrap-servers", kafka.bootstrapServers()));
        args.addAll(List.of("--checkpoint-interval", CHECKPOINT_INTERVAL));
        args.addAll(List.of(
                "--checkpoint-dir",
                directory.resolve("jobs").resolve(name).toUri().toString()));
        args.addAll(List.of("--parallelism", "1"));
        kafka.propertiesFile().ifPresent(file -> args.addAll(List.of("--kafka-properties", file.toString())));
        JobCommandLine.of(options).parseArgs(args.toArray(String[]::new));
        return options;
    }
}
