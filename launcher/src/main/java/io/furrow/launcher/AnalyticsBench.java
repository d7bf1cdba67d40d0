package io.furrow.launcher;

import java.io.PrintWriter;
import java.nio.charset.StandardCharsets;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.analytics.CollisionMeasurement;
import io.furrow.bench.analytics.CollisionPlan;
import io.furrow.bench.analytics.CollisionReport;
import io.furrow.bench.analytics.CollisionRun;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow bench analytics}. */
@Command(
        name = "analytics",
        abbreviateSynopsis = true,
        description = {
            "Collision updates per second through all three stages in a Flink cluster of this JVM, fed from memory,"
                    + " for several numbers of devices and cores; beside each the bare loop without Flink.",
            "Exit code 0 means that in every second that was compared as many encounters start as in the bare loop."
        })
final class AnalyticsBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--devices",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1000,10000,50000,100000",
            description = "Devices of each run. Default: ${DEFAULT-VALUE}.")
    private List<Integer> devices;

    @Option(
            names = "--cores",
            paramLabel = "N,…",
            split = ",",
            hideParamSyntax = true,
            defaultValue = "1,2",
            description = "Subtasks per stage of each run. Default: ${DEFAULT-VALUE}.")
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

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path output;

    @Option(names = "--plot", paramLabel = "FILE", description = "Also draw how the figures grow here, as SVG.")
    private Path plot;

    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        try (RunDirectory directory = RunDirectory.open(null)) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            CollisionMeasurement measurement = new CollisionMeasurement(directory.resolve("state"));
            List<CollisionRun> runs = new ArrayList<>();
            for (int parallelism : cores) {
                for (int each : devices) {
                    out.println("  " + each + " devices on " + parallelism);
                    out.flush();
                    runs.add(measurement.run(new CollisionPlan(
                            each, parallelism, Duration.ofSeconds(warmUp), Duration.ofSeconds(seconds))));
                }
            }
            CollisionReport report = new CollisionReport(runs);
            report.print(out);
            if (output != null) {
                Files.write(output, NgsiJson.write(report.json()));
            }
            if (plot != null) {
                Files.writeString(plot, report.svg(), StandardCharsets.UTF_8);
            }
            return report.agrees() ? 0 : 1;
        }
    }
}
