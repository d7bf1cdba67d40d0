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

import io.furrow.analytics.AnalyticsRegistry;
import io.furrow.cli.control.ReplayAnalyticsJob;
import io.furrow.cli.option.CommandException;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.flink.job.JobOptions;
import io.furrow.ingest.IngestJob;
import io.furrow.ingest.IngestOptions;
import io.furrow.ingest.normalize.NormalizeJob;
import io.furrow.ingest.normalize.NormalizeOptions;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.replay.ReplayJob;
import io.furrow.replay.ReplayOptions;

/** The jobs of a suite, configured with the same arguments as for {@code flink run}. */
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
     * @throws CommandException if a job rejects its options, with the job's message
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
     * @throws CommandException if it rejects its options
     */
    StreamExecutionEnvironment ofReplay(ReplayAnalyticsJob replay) {
        try {
            AnalyticsKind kind = AnalyticsKind.named(replay.job())
                    .orElseThrow(() -> new CommandException("There is no analytics job " + replay.job()));
            String[] own = Stream.concat(replay.options().stream(), own(kind)).toArray(String[]::new);
            return AnalyticsRegistry.assemble(parsed(replay.name(), AnalyticsRegistry.options(kind), own));
        } catch (ParameterException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    private Stream<String> own(AnalyticsKind kind) {
        return switch (kind) {
            case COLLISION -> collision();
            case TEMPERATURE -> Stream.of("--window", settings.window());
            default -> Stream.empty();
        };
    }

    private Stream<String> collision() {
        Path zones = directory.resolve(SuiteFields.ZONES);
        Stream<String> horizon = Stream.of("--horizon", settings.watch().horizon());
        Stream<String> yards = Files.exists(zones) ? Stream.of("--zones", zones.toString()) : Stream.empty();
        return Stream.concat(horizon, yards);
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
        for (AnalyticsKind kind : AnalyticsKind.values()) {
            String name = kind.jobName();
            String[] own = own(kind).toArray(String[]::new);
            plans.put(name, AnalyticsRegistry.assemble(parsed(name, AnalyticsRegistry.options(kind), own)));
        }
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
