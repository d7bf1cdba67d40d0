package io.furrow.bench.command;

import java.io.PrintWriter;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.sink.SinkMeasurement;
import io.furrow.bench.sink.SinkPlan;
import io.furrow.bench.sink.SinkReport;
import io.furrow.bench.sink.SinkRun;
import io.furrow.cli.option.HelpOption;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.Connectors;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench sink}. */
@Command(
        name = "sink",
        abbreviateSynopsis = true,
        description = {
            "Fills a topic with entities and lets the NGSI sink write them into a context broker that only answers: once each"
                    + " about an entity of its own, once many about the same few.",
            "The last column says what an HTTP server takes that only answers, in bodies of a hundred entities. Exit code 0"
                    + " means that the newest state of every entity came."
        })
final class SinkBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--records",
            paramLabel = "N",
            defaultValue = "100000",
            description = "Records of a run. Default: ${DEFAULT-VALUE}.")
    private int records;

    @Option(
            names = "--entities",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Entities that the records are about when they repeat. Default: ${DEFAULT-VALUE}.")
    private int entities;

    @Option(
            names = "--payload",
            paramLabel = "BYTES",
            defaultValue = "1000",
            description = "Length of a notification with one of the entities, at least 500. Default: ${DEFAULT-VALUE}.")
    private int payload;

    @Option(
            names = "--runs",
            paramLabel = "N",
            defaultValue = "5",
            description = "Runs of each kind after one that is not counted. Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Option(
            names = "--stand-in",
            description = "Measure runs into the context broker's stand-in too; their time includes the sink's start.")
    private boolean standIn;

    @Option(
            names = "--connector",
            paramLabel = "OPTION=VALUE",
            description = "An option of the connector, for instance --connector batch.size=200.")
    private Map<String, String> connectorOptions = new HashMap<>();

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path output;

    @Mixin
    private HelpOption help;

    /** One run under a name of its own. */
    private interface Run {
        SinkRun run(String name, SinkPlan plan) throws Exception;
    }

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Map<String, String> worker = Map.of("offset.flush.interval.ms", "250");
        try (RunDirectory directory = RunDirectory.open(null);
                BenchCluster cluster = BenchCluster.start(directory, worker, new Progress(out))) {
            SinkMeasurement measurement = new SinkMeasurement(cluster.kafka(), line -> {
                out.println("  " + line);
                out.flush();
            });
            List<SinkReport> reports = measure(measurement, cluster.connectors());
            reports.forEach(report -> report.print(out));
            if (output != null) {
                ArrayNode json = NgsiJson.mapper().createArrayNode();
                reports.forEach(report -> json.add(report.json()));
                Files.write(output, NgsiJson.write(json));
            }
            return reports.stream().allMatch(report -> report.missing() == 0) ? 0 : 1;
        }
    }

    private List<SinkReport> measure(SinkMeasurement measurement, Connectors connectors) throws Exception {
        SinkMeasurement.SinkStart sink = (name, topic, broker) -> connectors.put(name, settings(topic, broker));
        SinkPlan own = new SinkPlan(records, records, payload);
        SinkPlan repeated = new SinkPlan(records, Math.min(entities, records), payload);
        measurement.run("warm-up", own, sink);
        List<SinkReport> reports = new ArrayList<>();
        Run bare = (name, plan) -> measurement.run(name, plan, sink);
        reports.add(report("Each its own entity", "own", own, bare));
        reports.add(report("Repeated entities", "repeated", repeated, bare));
        if (standIn) {
            try (FiwareStandIn fiware = FiwareStandIn.start(FiwareSettings.httpOnly())) {
                Run into = (name, plan) -> measurement.runInto(fiware.contextBroker(), name, plan, sink);
                reports.add(report("Repeated entities into the stand-in", "stand-in", repeated, into));
            }
        }
        return reports;
    }

    private SinkReport report(String title, String name, SinkPlan plan, Run kind) throws Exception {
        List<SinkRun> all = new ArrayList<>();
        for (int run = 1; run <= runs; run++) {
            all.add(kind.run(name + "-" + run, plan));
        }
        return new SinkReport(title, all);
    }

    private Map<String, String> settings(String topic, URI broker) {
        Map<String, String> settings = new HashMap<>(Map.of(
                "connector.class",
                "io.furrow.connect.sink.NgsiSinkConnector",
                "tasks.max",
                "1",
                "topics",
                topic,
                "context.broker.url",
                broker.toString()));
        settings.putAll(connectorOptions);
        return settings;
    }
}
