package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Map;
import java.util.Properties;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.analytics.Figures;
import io.furrow.bench.ingest.IngestMeasurement;
import io.furrow.bench.replay.MaxMeasurement;
import io.furrow.bench.replay.ReplayBenchPlan;
import io.furrow.bench.replay.ReplayCluster;
import io.furrow.bench.replay.SeekMeasurement;
import io.furrow.bench.replay.TimingMeasurement;
import io.furrow.cli.option.HelpOption;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench replay}. */
@Command(
        name = "replay",
        abbreviateSynopsis = true,
        description = {
            "Lets the job replay play made-up missions from MongoDB's stand-in in memory, at-least-once, and bare loops write the"
                    + " same records, by turns; prints by how much events are behind their schedule, or events per second.",
            "Exit code 0 means that every event was on its topic."
        })
final class ReplayBench implements Callable<Integer> {
    private static final int TIMED_PER_SECOND = 100;
    private static final int MANY_PER_SECOND = 20;

    @Spec
    private CommandSpec spec;

    @Option(names = "--timing", description = "One replay at speed 1, 100 events a second.")
    private boolean timing;

    @Option(
            names = "--many",
            paramLabel = "N",
            defaultValue = "0",
            description = "So many replays at once at speed 1, 20 events a second each.")
    private int many;

    @Option(names = "--max", description = "One replay at speed max.")
    private boolean max;

    @Option(
            names = "--memory",
            description = "The heap that one replay at speed max holds, or with --many so many at speed 1.")
    private boolean memory;

    @Option(names = "--seek", description = "Seeks in a stored mission, without the job.")
    private boolean seek;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "60",
            description = "How long missions last at speed 1. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    @Option(
            names = "--events",
            paramLabel = "N",
            defaultValue = "500000",
            description =
                    "Events of the mission at speed max and of that of seeks; each takes some 4 kB of heap. Default: ${DEFAULT-VALUE}.")
    private int events;

    @Option(
            names = "--turns",
            paramLabel = "N",
            defaultValue = "3",
            description = "Turns that count, after one that does not. Default: ${DEFAULT-VALUE}.")
    private int turns;

    @Option(
            names = "--parallelism",
            paramLabel = "N",
            defaultValue = "2",
            description = "Of the job. Default: ${DEFAULT-VALUE}.")
    private int parallelism;

    @Option(
            names = "--checkpoint-millis",
            paramLabel = "MS",
            defaultValue = "1000",
            description = "Milliseconds between checkpoints. Default: ${DEFAULT-VALUE}.")
    private long checkpointMillis;

    @Option(names = "--output", paramLabel = "FILE", description = "Also write the figures here, as JSON.")
    private Path output;

    @Mixin
    private HelpOption help;

    private final List<Figures> all = new ArrayList<>();

    @Override
    public Integer call() throws Exception {
        Progress progress = new Progress(out());
        ReplayBenchPlan plan = new ReplayBenchPlan(seconds, turns, parallelism, Duration.ofMillis(checkpointMillis));
        try (RunDirectory directory = RunDirectory.open(null)) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            try (Closeables parts = directory.closingFirst(new Closeables())) {
                EmbeddedKafka kafka = parts.add(
                        "Kafka",
                        progress.step(
                                "Kafka",
                                () -> EmbeddedKafka.start(
                                        directory.resolve("kafka"),
                                        0,
                                        Map.of("log.message.timestamp.type", "LogAppendTime"))));
                EmbeddedMongo mongo = parts.add("MongoDB", EmbeddedMongo.inMemory());
                EmbeddedFlink flink =
                        parts.add("Flink", progress.step("Flink", () -> EmbeddedFlink.start(parallelism, 0)));
                Properties client = new Properties();
                client.setProperty("bootstrap.servers", kafka.bootstrapServers());
                ReplayCluster cluster = parts.add(
                        "replays", new ReplayCluster(client, mongo.uri(), directory.resolve("checkpoints"), plan));
                IngestMeasurement.Running job = IngestBench.start(flink, "replay", cluster.job());
                boolean complete = measure(cluster, plan);
                if (seek) {
                    complete &= new SeekMeasurement(mongo.uri(), events, turns, this::say).run(this::show);
                }
                job.cancel();
                write();
                return complete ? 0 : 1;
            }
        }
    }

    private boolean measure(ReplayCluster cluster, ReplayBenchPlan plan) throws Exception {
        boolean complete = true;
        boolean any = timing || many > 0 || max || memory || seek;
        if (timing || !any) {
            complete &= new TimingMeasurement(cluster, plan, 1, TIMED_PER_SECOND, this::say).run(this::show);
        }
        if (many > 0 && !memory) {
            complete &= new TimingMeasurement(cluster, plan, many, MANY_PER_SECOND, this::say).run(this::show);
        }
        if (max) {
            complete &= new MaxMeasurement(cluster, plan, events, this::say).run(this::show);
        }
        if (memory) {
            long held = many > 0
                    ? new TimingMeasurement(cluster, plan, many, MANY_PER_SECOND, this::say).heldWhilePlayed()
                    : new MaxMeasurement(cluster, plan, events, this::say).heldWhilePlayed();
            say("held at most: %,d MiB".formatted(held));
        }
        return complete;
    }

    private void show(Figures figures) {
        figures.print(out());
        all.add(figures);
    }

    private void say(String line) {
        out().println("  " + line);
        out().flush();
    }

    private PrintWriter out() {
        return spec.commandLine().getOut();
    }

    private void write() throws Exception {
        if (output != null) {
            ArrayNode json = NgsiJson.mapper().createArrayNode();
            all.forEach(figures -> json.add(figures.json()));
            Files.write(output, NgsiJson.write(json));
        }
    }
}
