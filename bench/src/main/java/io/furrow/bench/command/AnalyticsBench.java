package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.analytics.CollisionMeasurement;
import io.furrow.bench.analytics.CollisionReport;
import io.furrow.bench.analytics.CollisionRun;
import io.furrow.bench.analytics.FieldMeasurement;
import io.furrow.bench.analytics.Figures;
import io.furrow.bench.analytics.SustainedRate;
import io.furrow.bench.analytics.TopicMeasurement;
import io.furrow.bench.analytics.load.CollisionPlan;
import io.furrow.bench.ingest.IngestMeasurement.Cluster;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.RunDirectory;

/** {@code ./furrow bench analytics}. */
@Command(
        name = "analytics",
        abbreviateSynopsis = true,
        sortOptions = false,
        description = {
            "What collision, temperature and presence take on a Kafka and a Flink of this JVM, for several numbers of"
                    + " devices and cores; beside each figure a bare loop without Flink.",
            "Exit code 0 means that in every second that was compared as many encounters start as in the bare loop, and that"
                    + " the rate was held, as far as these parts were measured."
        })
final class AnalyticsBench implements Callable<Integer> {
    /** What can be measured. */
    enum Part {
        MEMORY,
        KAFKA,
        HELD,
        CROWD,
        BACKLOG,
        FIELDS
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--parts",
            paramLabel = "PART,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "MEMORY,KAFKA,HELD,CROWD,BACKLOG,FIELDS",
            description = {
                "MEMORY: collision updates per second, from memory.",
                "KAFKA: the same from NGSI entities in a topic to a topic of results.",
                "HELD: whether the consumer's lag grows while devices report once a second.",
                "CROWD: devices on one spot: the cell that they share, then the job, for five minutes each.",
                "BACKLOG: what a job that was away for an hour holds in memory while it catches up.",
                "FIELDS: points per second and core of the joins with fields.",
                "Default: all."
            })
    private List<Part> parts;

    @Option(
            names = "--devices",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1000,10000,50000,100000",
            description = "Devices of each run of MEMORY and KAFKA. Default: ${DEFAULT-VALUE}.")
    private List<Integer> devices;

    @Option(
            names = "--cores",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1,2",
            description = "Subtasks per stage of each run; HELD takes the most. Default: ${DEFAULT-VALUE}.")
    private List<Integer> cores;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            defaultValue = "20",
            description = "Seconds of each run that do not count. Default: ${DEFAULT-VALUE}.")
    private int warmUp;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "20",
            description = "Seconds of each run that count. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    @Mixin
    private final AnalyticsLoad load = new AnalyticsLoad();

    @Mixin
    private final CrowdLoad crowds = new CrowdLoad();

    @Mixin
    private final BacklogLoad backlogs = new BacklogLoad();

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path output;

    @Option(
            names = "--plots",
            paramLabel = "DIR",
            description = "Also draw how the figures grow, as SVG in this folder.")
    private Path plots;

    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean help;

    private AnalyticsFigures report;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        out.printf(
                "%d processors; a core is a subtask per stage. --cores 1 leaves the other processor to Flink, the broker and"
                        + " the collector: for what one alone does, run under taskset -c 0.%n",
                Runtime.getRuntime().availableProcessors());
        boolean good = true;
        report = AnalyticsFigures.to(out, plots);
        try (RunDirectory directory = RunDirectory.open(null)) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            for (Part part : Part.values()) {
                if (parts.contains(part)) {
                    good &= measure(part, directory);
                }
            }
        }
        if (output != null) {
            report.write(output);
        }
        return good ? 0 : 1;
    }

    private boolean measure(Part part, RunDirectory directory) throws Exception {
        return switch (part) {
            case MEMORY -> memory(directory);
            case KAFKA -> onKafka(directory, "kafka", this::kafka);
            case HELD -> onKafka(directory, "held", this::held);
            case CROWD -> crowds.cells(report) & onKafka(directory, "crowd", this::crowd);
            case BACKLOG -> onKafka(directory, "backlog", measurement -> backlogs.run(measurement, report));
            case FIELDS -> fields();
        };
    }

    private boolean memory(RunDirectory directory) throws Exception {
        CollisionMeasurement measurement = new CollisionMeasurement(directory.resolve("state"));
        List<CollisionRun> runs = new ArrayList<>();
        for (int parallelism : cores) {
            for (int each : devices) {
                report.tell("from memory: " + each + " devices on " + parallelism);
                runs.add(measurement.run(
                        new CollisionPlan(each, parallelism, Duration.ofSeconds(warmUp), Duration.ofSeconds(seconds))));
            }
        }
        CollisionReport compared = new CollisionReport(runs);
        Figures figures = compared.figures();
        report.add("memory", figures);
        report.draw("memory-devices", figures.svg("devices", List.of("updates/s", "bare loop"), "cores"));
        report.draw("memory-cores", figures.svg("cores", List.of("updates/s"), "devices"));
        return compared.agrees();
    }

    private boolean kafka(TopicMeasurement measurement) throws Exception {
        Figures figures =
                new Figures("Collisions from NGSI entities in a topic: reading, three stages, topic of results");
        for (int parallelism : cores) {
            for (int each : devices) {
                for (int partitions : load.partitions) {
                    report.tell(
                            "from Kafka: " + each + " devices on " + parallelism + ", " + partitions + " partitions");
                    measurement.updates(each, parallelism, partitions, load.records, figures);
                }
            }
        }
        report.add("kafka", figures);
        report.draw("kafka-devices", figures.svg("devices", List.of("updates/s", "bare loop"), "cores"));
        report.draw("kafka-cores", figures.svg("cores", List.of("updates/s"), "devices"));
        return true;
    }

    private boolean held(TopicMeasurement measurement) throws Exception {
        Figures figures =
                new Figures("Devices that report once a second, and the lag of the job's consumer in records");
        boolean good = true;
        ObjectNode lags = report.object("heldLags");
        for (double side : load.heldSides) {
            report.tell("%,d devices at 1 Hz on %,.0f m".formatted(load.heldDevices, side));
            SustainedRate held = measurement.held(new TopicMeasurement.Held(
                    load.heldDevices,
                    side,
                    most(cores),
                    load.heldOngoing,
                    Duration.ofSeconds(warmUp),
                    Duration.ofSeconds(load.heldSeconds)));
            held.addTo(figures);
            String name = "held-%.0f".formatted(side);
            lags.putPOJO(name, held.lags());
            report.draw(name, held.svg());
            good &= held.isHeld();
        }
        report.add("held", figures);
        return good;
    }

    private boolean crowd(TopicMeasurement measurement) throws Exception {
        return crowds.job(measurement, most(cores), Duration.ofSeconds(warmUp), report);
    }

    private boolean fields() throws Exception {
        Figures figures = new Figures("Joins with fields, from memory: " + load.fields + " fields of 50 vertices");
        new FieldMeasurement(load.fields, 50, load.points, report::tell).run(cores, figures);
        report.add("fields", figures);
        report.draw("fields-cores", figures.svg("cores", List.of("points/s", "bare loop"), "join of"));
        return true;
    }

    private interface OnKafka {
        boolean measure(TopicMeasurement measurement) throws Exception;
    }

    private boolean onKafka(RunDirectory directory, String folder, OnKafka part) throws Exception {
        Progress progress = new Progress(spec.commandLine().getOut());
        Path data = directory.resolve(folder);
        try (Closeables engines = directory.closingFirst(new Closeables())) {
            EmbeddedKafka kafka =
                    engines.add("Kafka", progress.step("Kafka", () -> EmbeddedKafka.start(data.resolve("broker"))));
            EmbeddedFlink flink =
                    engines.add("Flink", progress.step("Flink", () -> EmbeddedFlink.start(most(cores), 0)));
            Properties client = new Properties();
            client.setProperty("bootstrap.servers", kafka.bootstrapServers());
            return part.measure(new TopicMeasurement(
                    new Cluster(
                            client, (name, job) -> IngestBench.start(flink, name, job), data.resolve("checkpoints")),
                    report::tell));
        }
    }

    private static int most(List<Integer> numbers) {
        return numbers.stream().mapToInt(Integer::intValue).max().orElse(1);
    }
}
