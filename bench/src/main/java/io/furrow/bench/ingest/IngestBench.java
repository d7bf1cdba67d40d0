package io.furrow.bench.ingest;

import java.util.List;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.OutputOption;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.job.Delivery;

/** {@code ./furrow bench ingest}. */
@Command(
        name = "ingest",
        description = {
            "Runs the job ingest and jobs that only copy bytes on the same topic in turns, on their own Kafka "
                    + "and Flink, and prints records per second and ratios.",
            "Exit code 0 means that every record was on the topics of its domain and mission once."
        })
public final class IngestBench extends Benchmark {
    @Option(names = "--records", paramLabel = "N", description = "Records of the input topic. " + DEFAULT)
    private int records = 900_000;

    @Option(names = "--partitions", paramLabel = "N", description = "Partitions of the input topic. " + DEFAULT)
    private int partitions = 4;

    @Option(
            names = "--devices",
            paramLabel = "N",
            description = "Devices, each of which reports once a second of event time. " + DEFAULT)
    private int devices = 1000;

    @Option(names = "--missions", paramLabel = "N", description = "Missions of the one domain. " + DEFAULT)
    private int missions = 4;

    @Option(names = "--payload", paramLabel = "BYTES", description = "Length of a record's value, about. " + DEFAULT)
    private int payload = 1000;

    @Option(
            names = "--turns",
            paramLabel = "N",
            description = "Turns of each job that count, after one that does not. " + DEFAULT)
    private int turns = 3;

    @Option(names = "--parallelism", paramLabel = "N", description = "Of every job. " + DEFAULT)
    private int parallelism = 2;

    @Option(
            names = "--checkpoint-millis",
            paramLabel = "MS",
            description = "Milliseconds between checkpoints. " + DEFAULT)
    private long checkpointMillis = 2000;

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

    @Option(names = "--mongo", description = "The job ingest also stores the missions in the embedded MongoDB.")
    private boolean mongo;

    @Mixin
    private final OutputOption output = new OutputOption();

    @Override
    public Integer call() throws Exception {
        IngestReport.Plan plan =
                new IngestReport.Plan(records, partitions, payload, devices, missions, parallelism, checkpointMillis);
        try (Engines engines = Engines.in(null, out()).kafka().flink(parallelism)) {
            String missionStore = mongo
                    ? engines.start("MongoDB", () -> EmbeddedMongo.start(engines.folder("mongo")))
                            .uri()
                    : null;
            IngestMeasurement measurement = new IngestMeasurement(plan, engines, missionStore, this::say);
            IngestReport report = new IngestReport(plan, measurement.run(jobs, deliveries, turns));
            print(report.figures());
            output.write(report.json());
            return report.isComplete() ? 0 : 1;
        }
    }
}
