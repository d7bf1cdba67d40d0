package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Callable;
import java.util.concurrent.TimeUnit;

import org.apache.flink.api.common.JobID;
import org.apache.flink.streaming.api.environment.StreamExecutionEnvironment;
import org.apache.flink.streaming.api.graph.StreamGraph;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.ingest.IngestMeasurement;
import io.furrow.bench.ingest.IngestPlan;
import io.furrow.bench.ingest.IngestReport;
import io.furrow.bench.ingest.ComparedJob;
import io.furrow.cli.option.HelpOption;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.job.Delivery;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench ingest}. */
@Command(
        name = "ingest",
        abbreviateSynopsis = true,
        description = {
            "Lets the job ingest and jobs that only copy bytes read the same topic by turns, on a Kafka and a Flink of their"
                    + " own, and prints records per second and ratios.",
            "Exit code 0 means that every record was on the topics of its domain and mission once."
        })
final class IngestBench implements Callable<Integer> {
    private static final long STOP_SECONDS = 30;

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--records",
            paramLabel = "N",
            defaultValue = "900000",
            description = "Records of the input topic. Default: ${DEFAULT-VALUE}.")
    private int records;

    @Option(
            names = "--partitions",
            paramLabel = "N",
            defaultValue = "4",
            description = "Partitions of the input topic. Default: ${DEFAULT-VALUE}.")
    private int partitions;

    @Option(
            names = "--devices",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Devices, each of which reports once a second of event time. Default: ${DEFAULT-VALUE}.")
    private int devices;

    @Option(
            names = "--missions",
            paramLabel = "N",
            defaultValue = "4",
            description = "Missions of the one domain. Default: ${DEFAULT-VALUE}.")
    private int missions;

    @Option(
            names = "--payload",
            paramLabel = "BYTES",
            defaultValue = "1000",
            description = "Length of a record's value, about. Default: ${DEFAULT-VALUE}.")
    private int payload;

    @Option(
            names = "--turns",
            paramLabel = "N",
            defaultValue = "3",
            description = "Turns of each job that count, after one that does not. Default: ${DEFAULT-VALUE}.")
    private int turns;

    @Option(
            names = "--parallelism",
            paramLabel = "N",
            defaultValue = "2",
            description = "Of every job. Default: ${DEFAULT-VALUE}.")
    private int parallelism;

    @Option(
            names = "--checkpoint-millis",
            paramLabel = "MS",
            defaultValue = "2000",
            description = "Milliseconds between checkpoints. Default: ${DEFAULT-VALUE}.")
    private long checkpointMillis;

    @Option(
            names = "--delivery",
            paramLabel = "MODE,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "at-least-once,exactly-once",
            description = "at-least-once, exactly-once. Default: both.")
    private List<Delivery> deliveries;

    @Option(
            names = "--jobs",
            paramLabel = "JOB,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "COPY_ONCE,COPY_TWICE,ROUTES,INGEST",
            description = "COPY_ONCE, COPY_TWICE, ROUTES, INGEST. Default: all.")
    private List<ComparedJob> jobs;

    @Option(
            names = "--mongo",
            description =
                    "The job ingest also keeps the missions, in a server of the suite that speaks MongoDB's protocol.")
    private boolean mongo;

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path output;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Progress progress = new Progress(out);
        IngestPlan plan = new IngestPlan(
                records,
                partitions,
                devices,
                missions,
                payload,
                turns,
                parallelism,
                Duration.ofMillis(checkpointMillis));
        try (RunDirectory directory = RunDirectory.open(null)) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            try (Closeables parts = directory.closingFirst(new Closeables())) {
                EmbeddedKafka kafka = parts.add(
                        "Kafka", progress.step("Kafka", () -> EmbeddedKafka.start(directory.resolve("kafka"))));
                EmbeddedFlink flink =
                        parts.add("Flink", progress.step("Flink", () -> EmbeddedFlink.start(parallelism, 0)));
                String missionStore = mongo
                        ? parts.add("MongoDB", EmbeddedMongo.start(directory.resolve("mongo")))
                                .uri()
                        : null;
                Properties client = new Properties();
                client.setProperty("bootstrap.servers", kafka.bootstrapServers());
                IngestMeasurement measurement = new IngestMeasurement(
                        plan,
                        new IngestMeasurement.Cluster(
                                client,
                                (name, job) -> start(flink, name, job),
                                directory.resolve("checkpoints"),
                                missionStore),
                        line -> {
                            out.println("  " + line);
                            out.flush();
                        });
                IngestReport report = new IngestReport(plan, measurement.run(jobs, deliveries));
                report.print(out);
                if (output != null) {
                    Files.write(output, NgsiJson.write(report.json()));
                }
                return report.isComplete() ? 0 : 1;
            }
        }
    }

    static IngestMeasurement.Running start(EmbeddedFlink flink, String name, StreamExecutionEnvironment job) {
        StreamGraph graph = job.getStreamGraph();
        graph.setJobName(name);
        JobID id = flink.submit(graph);
        return () -> {
            flink.cluster().cancelJob(id).get(STOP_SECONDS, TimeUnit.SECONDS);
            flink.cluster().requestJobResult(id).get(STOP_SECONDS, TimeUnit.SECONDS);
        };
    }
}
