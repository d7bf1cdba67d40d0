package io.furrow.launcher.suite;

import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.stream.Stream;

import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import picocli.CommandLine.ParameterException;

import io.furrow.analytics.collision.CollisionJob;
import io.furrow.analytics.collision.CollisionOptions;
import io.furrow.analytics.presence.PresenceJob;
import io.furrow.analytics.presence.PresenceOptions;
import io.furrow.analytics.temperature.TemperatureJob;
import io.furrow.analytics.temperature.TemperatureOptions;
import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.cli.option.CommandException;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.ingest.normalize.NormalizeJob;
import io.furrow.ingest.normalize.NormalizeOptions;
import io.furrow.replay.ReplayJob;
import io.furrow.replay.ReplayOptions;

/** The jobs of a suite, set up with the same words that one would say to {@code flink run}. */
final class SuiteJobs {
    /** Folder of stored images in the run directory. */
    static final String IMAGES = "images";

    private final SuiteSettings settings;
    private final KafkaAccess kafka;
    private final String mongo;
    private final RunDirectory directory;

    SuiteJobs(SuiteSettings settings, KafkaAccess kafka, String mongo, RunDirectory directory) {
        this.settings = settings;
        this.kafka = kafka;
        this.mongo = mongo;
        this.directory = directory;
    }

    /**
     * By name.
     *
     * @throws CommandException if a job refuses its options, in the job's own words
     */
    Map<String, StreamExecutionEnvironment> all() {
        try {
            return assembled();
        } catch (ParameterException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    /**
     * An analytics job on a replay, with the settings of the live one.
     *
     * @throws CommandException if it refuses its options
     */
    StreamExecutionEnvironment ofReplay(ReplayAnalyticsJob replay) {
        try {
            return switch (replay.job()) {
                case "collision" ->
                    CollisionJob.assemble(
                            parsed(replay.name(), new CollisionOptions(), withOptions(replay, collision())));
                case "temperature" ->
                    TemperatureJob.assemble(parsed(
                            replay.name(),
                            new TemperatureOptions(),
                            withOptions(replay, "--window", settings.window())));
                case "presence" ->
                    PresenceJob.assemble(parsed(replay.name(), new PresenceOptions(), withOptions(replay)));
                default -> throw new CommandException("There is no analytics job " + replay.job());
            };
        } catch (ParameterException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    private String[] collision() {
        Path zones = directory.resolve(SuiteFields.ZONES);
        Stream<String> horizon = Stream.of("--horizon", settings.watch().horizon());
        Stream<String> yards = Files.exists(zones) ? Stream.of("--zones", zones.toString()) : Stream.empty();
        return Stream.concat(horizon, yards).toArray(String[]::new);
    }

    private static String[] withOptions(ReplayAnalyticsJob replay, String... own) {
        return Stream.concat(replay.options().stream(), Stream.of(own)).toArray(String[]::new);
    }

    private Map<String, StreamExecutionEnvironment> assembled() {
        Map<String, StreamExecutionEnvironment> plans = new LinkedHashMap<>();
        plans.put(
                "ingest",
                IngestJob.assemble(parsed(
                        "ingest",
                        new IngestOptions(),
                        "--images",
                        directory.resolve(IMAGES).toString(),
                        "--mongo",
                        mongo)));
        plans.put("normalize", NormalizeJob.assemble(parsed("normalize", new NormalizeOptions())));
        plans.put(
                "temperature",
                TemperatureJob.assemble(
                        parsed("temperature", new TemperatureOptions(), "--window", settings.window())));
        plans.put("collision", CollisionJob.assemble(parsed("collision", new CollisionOptions(), collision())));
        plans.put("presence", PresenceJob.assemble(parsed("presence", new PresenceOptions())));
        plans.put("replay", ReplayJob.assemble(parsed("replay", new ReplayOptions(), "--mongo", mongo)));
        return plans;
    }

    private <T extends JobOptions> T parsed(String name, T options, String... own) {
        List<String> args = new ArrayList<>(List.of(own));
        args.addAll(List.of("--bootstrap-servers", kafka.bootstrapServers()));
        args.addAll(List.of(
                "--checkpoint-dir", JobFolder.location(directory.resolve("jobs").resolve(name))));
        args.addAll(List.of("--parallelism", "1"));
        kafka.propertiesFile().ifPresent(file -> args.addAll(List.of("--kafka-properties", file.toString())));
        JobCommandLine.of(options).parseArgs(args.toArray(String[]::new));
        return options;
    }
}
