package io.furrow.bench.sink;

import java.net.URI;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.OutputOption;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.launcher.suite.Connectors;

/** {@code ./furrow bench sink}. */
@Command(
        name = "sink",
        description = {
            "Fills a topic with entities and lets the NGSI sink write them into a context broker that only answers: once each"
                    + " about an entity of its own, once many about the same few.",
            "The last column says what an HTTP server takes that only answers, in bodies of a hundred entities. Exit code 0"
                    + " means that the newest state of every entity came."
        })
public final class SinkBench extends Benchmark {
    @Option(names = "--records", paramLabel = "N", description = "Records of a run. " + DEFAULT)
    private int records = 100_000;

    @Option(
            names = "--entities",
            paramLabel = "N",
            description = "Entities that the records are about when they repeat. " + DEFAULT)
    private int entities = 1000;

    @Option(
            names = "--payload",
            paramLabel = "BYTES",
            description = "Length of a notification with one of the entities, at least 500. " + DEFAULT)
    private int payload = 1000;

    @Option(
            names = "--runs",
            paramLabel = "N",
            description = "Runs of each kind after one that is not counted. " + DEFAULT)
    private int runs = 5;

    @Option(
            names = "--stand-in",
            description = "Measure runs into the context broker's stand-in too; their time includes the sink's start.")
    private boolean standIn;

    @Option(
            names = "--connector",
            paramLabel = "OPTION=VALUE",
            description = "An option of the connector, for instance --connector batch.size=200.")
    private Map<String, String> connectorOptions = new HashMap<>();

    @Mixin
    private final OutputOption output = new OutputOption();

    @Override
    public Integer call() throws Exception {
        try (Engines engines = Engines.in(null, out()).kafka()) {
            Connectors connectors = engines.connect(Map.of("offset.flush.interval.ms", "250"));
            List<SinkReport> reports = measure(new SinkMeasurement(
                    engines.client(), (name, broker) -> connectors.put(name, settings(name, broker)), this::say));
            reports.forEach(report -> print(report.figures()));
            output.write(reports.stream().map(SinkReport::json).toList());
            return reports.stream().allMatch(report -> report.missing() == 0) ? 0 : 1;
        }
    }

    private List<SinkReport> measure(SinkMeasurement measurement) throws Exception {
        SinkReport.Plan own = new SinkReport.Plan(records, records, payload);
        SinkReport.Plan repeated = new SinkReport.Plan(records, Math.min(entities, records), payload);
        measurement.run("warm-up", own, null);
        List<SinkReport> reports = new ArrayList<>();
        reports.add(new SinkReport("Each its own entity", own, measurement.runs(runs, "own", own, null)));
        reports.add(new SinkReport("Repeated entities", repeated, measurement.runs(runs, "repeated", repeated, null)));
        if (standIn) {
            try (FiwareStandIn fiware = FiwareStandIn.start(FiwareSettings.httpOnly())) {
                reports.add(new SinkReport(
                        "Repeated entities into the stand-in",
                        repeated,
                        measurement.runs(runs, "stand-in", repeated, fiware.contextBroker())));
            }
        }
        return reports;
    }

    private Map<String, String> settings(String topic, URI broker) {
        Map<String, String> settings = new HashMap<>();
        settings.put("connector.class", "io.furrow.connect.sink.NgsiSinkConnector");
        settings.put("tasks.max", "1");
        settings.put("topics", topic);
        settings.put("context.broker.url", broker.toString());
        settings.putAll(connectorOptions);
        return settings;
    }
}
