package io.furrow.bench.analytics;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.Collections;
import java.util.List;

import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.analytics.load.SyntheticFields;
import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Chart;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.OutputOption;

/** {@code ./furrow bench analytics}. */
@Command(
        name = "analytics",
        sortOptions = false,
        description = {
            "Measures collision, temperature, presence and coverage on a Kafka and a Flink in this JVM for several numbers "
                    + "of devices and cores, each beside a bare loop without Flink.",
            "Exit code 0 means that in every second that was compared as many encounters start as in the bare "
                    + "loop, and that the rate was held, as far as these parts were measured."
        })
public final class AnalyticsBench extends Benchmark {
    private static final Duration CELL_MEASURED = Duration.ofSeconds(3);

    /** The measurements to choose from. */
    enum Part {
        MEMORY,
        KAFKA,
        HELD,
        CROWD,
        BACKLOG,
        FIELDS,
        COVERAGE
    }

    @Option(
            names = "--parts",
            paramLabel = "PART,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "MEMORY,KAFKA,HELD,CROWD,BACKLOG,FIELDS,COVERAGE",
            description = {
                "MEMORY: collision updates per second, from memory.",
                "KAFKA: the same from NGSI entities in a topic to a topic of results.",
                "HELD: whether the consumer lag grows while devices report once a second.",
                "CROWD: devices on one spot: the cell that they share, then the job, for five minutes each.",
                "BACKLOG: what a job that was away for an hour holds in memory while it catches up.",
                "FIELDS: points per second and core of the joins with fields.",
                "COVERAGE: reports of robots per second and core that become worked area, beside a job that only copies.",
                "Default: all."
            })
    private List<Part> parts;

    @Option(
            names = "--devices",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1000,10000,50000,100000",
            description = "Devices of each run of MEMORY and KAFKA. " + DEFAULT)
    private List<Integer> devices;

    @Option(
            names = "--cores",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1,2",
            description = "Subtasks per stage of each run; HELD takes the most. " + DEFAULT)
    private List<Integer> cores;

    @Option(names = "--warmup", paramLabel = "S", description = "Warm-up seconds of each run. " + DEFAULT)
    private int warmUp = 20;

    @Option(names = "--seconds", paramLabel = "S", description = "Measured seconds of each run. " + DEFAULT)
    private int seconds = 20;

    @Mixin
    private final AnalyticsOptions load = new AnalyticsOptions();

    @Mixin
    private final OutputOption output = new OutputOption();

    @Option(
            names = "--plots",
            paramLabel = "DIR",
            description = "Also draw how the figures grow, as SVG in this folder.")
    private Path plots;

    private final ObjectNode json = JsonNodeFactory.instance.objectNode();

    @Override
    public Integer call() throws Exception {
        print(
                "%d processors; a core is a subtask per stage. --cores 1 leaves the other processor to Flink, the broker and"
                        + " the collector: for what one alone does, run under taskset -c 0.%n",
                Runtime.getRuntime().availableProcessors());
        if (plots != null) {
            Files.createDirectories(plots);
        }
        boolean good = true;
        for (Part part : Part.values()) {
            if (parts.contains(part)) {
                good &= measure(part);
            }
        }
        output.write(json);
        return good ? 0 : 1;
    }

    private boolean measure(Part part) throws Exception {
        return switch (part) {
            case MEMORY -> memory();
            case KAFKA -> onKafka(this::kafka);
            case HELD -> onKafka(this::held);
            case CROWD -> cells() & onKafka(this::crowd);
            case BACKLOG -> onKafka(this::backlog);
            case FIELDS -> fields();
            case COVERAGE -> coverage();
        };
    }

    private boolean memory() throws Exception {
        List<CollisionReport.Run> runs = new ArrayList<>();
        try (Engines none = Engines.in(null, out())) {
            CollisionMeasurement measurement = new CollisionMeasurement(none.folder("state"));
            for (int parallelism : cores) {
                for (int each : devices) {
                    say("from memory: " + each + " devices on " + parallelism);
                    runs.add(measurement.run(new CollisionReport.Plan(each, parallelism, warmUp(), seconds(seconds))));
                }
            }
        }
        CollisionReport compared = new CollisionReport(runs);
        Figures figures = compared.figures();
        add("memory", figures);
        draw("memory-devices", figures.chart("devices", List.of("updates/s", "bare loop"), "cores"));
        draw("memory-cores", figures.chart("cores", List.of("updates/s"), "devices"));
        return compared.agrees();
    }

    private boolean kafka(TopicMeasurement measurement) throws Exception {
        Figures figures =
                new Figures("Collisions from NGSI entities in a topic: reading, three stages, topic of results");
        for (int parallelism : cores) {
            for (int each : devices) {
                for (int partitions : load.partitions) {
                    say("from Kafka: " + each + " devices on " + parallelism + ", " + partitions + " partitions");
                    measurement.updates(each, parallelism, partitions, load.records, figures);
                }
            }
        }
        add("kafka", figures);
        draw("kafka-devices", figures.chart("devices", List.of("updates/s", "bare loop"), "cores"));
        draw("kafka-cores", figures.chart("cores", List.of("updates/s"), "devices"));
        return true;
    }

    private boolean held(TopicMeasurement measurement) throws Exception {
        Figures figures =
                new Figures("Devices that report once a second, and the lag of the job's consumer in records");
        boolean good = true;
        ObjectNode lags = json.putObject("heldLags");
        for (double side : load.heldSides) {
            say("%,d devices at 1 Hz on %,.0f m".formatted(load.heldDevices, side));
            SustainedRate rate = measurement.sustained(
                    new SustainedRate.Plan(load.heldDevices, side, mostCores(), load.heldOngoing),
                    warmUp(),
                    load.heldSeconds);
            rate.addTo(figures);
            String name = "held-%.0f".formatted(side);
            lags.putPOJO(name, rate.lags());
            draw(name, rate.chart());
            good &= rate.isHeld();
        }
        add("held", figures);
        return good;
    }

    /** Measures the cell that devices on one spot share, in isolation. */
    private boolean cells() {
        Figures figures = new Figures("Devices on one spot, by processor time of the cell alone");
        for (int each : load.crowds) {
            for (int limit : List.of(0, load.crowd)) {
                say("%,d devices on one spot, --crowd %d".formatted(each, limit));
                CrowdMeasurement.run(each, limit, CELL_MEASURED, figures);
            }
        }
        add("crowdCells", figures);
        return true;
    }

    /** Measures the job with its defaults. */
    private boolean crowd(TopicMeasurement measurement) throws Exception {
        Figures figures = new Figures("Devices on one spot at 1 Hz beside a fleet: lag of the results");
        int most = Collections.max(load.crowds);
        say("%,d devices on one spot beside %,d".formatted(most, load.crowdOthers));
        CrowdResults results =
                measurement.crowd(most, load.crowdOthers, mostCores(), warmUp(), load.crowdSeconds, figures);
        results.overflows().forEach(this::say);
        add("crowd", figures);
        return results.isSustained();
    }

    private boolean backlog(TopicMeasurement measurement) throws Exception {
        Figures figures = new Figures("A job that catches up with two partitions, one of them slower to read");
        for (String maxDrift : load.backlogDrifts) {
            say("%,d s of %,d devices, --max-drift %s".formatted(load.backlogSeconds, load.backlogDevices, maxDrift));
            measurement.backlog(
                    new Backlog(load.backlogDevices, load.backlogSeconds, load.backlogPadding, maxDrift), figures);
        }
        add("backlog", figures);
        return true;
    }

    private boolean fields() throws Exception {
        Figures figures = new Figures("Joins with fields, from memory: " + load.fields + " fields of 50 vertices");
        new FieldMeasurement(load.fields, 50, load.points, this::say).run(cores, figures);
        add("fields", figures);
        draw("fields-cores", figures.chart("cores", List.of("points/s", "bare loop"), "join of"));
        return true;
    }

    private boolean coverage() throws Exception {
        Figures figures = new Figures("Worked area, from memory: a thousand robots in twenty fields of 50 vertices");
        new CoverageMeasurement(new SyntheticFields(20, 50), load.points, this::say).run(cores, figures);
        add("coverage", figures);
        return true;
    }

    private interface OnKafka {
        boolean measure(TopicMeasurement measurement) throws Exception;
    }

    private boolean onKafka(OnKafka part) throws Exception {
        try (Engines engines = Engines.in(null, out())) {
            return part.measure(new TopicMeasurement(engines.kafka().flink(mostCores()), this::say));
        }
    }

    private void add(String name, Figures figures) {
        print(figures);
        json.set(name, figures.json());
    }

    private void draw(String name, Chart chart) throws IOException {
        if (plots != null) {
            chart.saveSvg(plots.resolve(name + ".svg"));
        }
    }

    private int mostCores() {
        return Collections.max(cores);
    }

    private Duration warmUp() {
        return seconds(warmUp);
    }

    private static Duration seconds(long seconds) {
        return Duration.ofSeconds(seconds);
    }
}
