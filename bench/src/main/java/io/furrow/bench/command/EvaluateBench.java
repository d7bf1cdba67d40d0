package io.furrow.bench.command;

import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.concurrent.Callable;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.evaluation.Calibration;
import io.furrow.bench.evaluation.Evaluation;
import io.furrow.bench.evaluation.EvaluationReport;
import io.furrow.bench.evaluation.EvaluationResults;
import io.furrow.bench.evaluation.Sweep;
import io.furrow.bench.whole.Checkout;
import io.furrow.cli.option.HelpOption;

/** {@code ./furrow bench evaluate}. */
@Command(
        name = "evaluate",
        abbreviateSynopsis = true,
        description =
                "Repeats the evaluation of the WeLASER platform: sends four sweeps of load at the devices' end of the embedded suite, and reports"
                        + " what arrived at a reader, how late, twice or out of order, in a page with plots. One that was interrupted goes on"
                        + " where it was.")
final class EvaluateBench implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--sweeps",
            paramLabel = "SWEEP",
            split = ",",
            defaultValue = "PERIOD,DEVICES,PAYLOAD,SUBSCRIPTIONS",
            description = "What is measured: ${COMPLETION-CANDIDATES}. Default: all.")
    private List<Sweep> sweeps;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "60",
            description =
                    "How long each point is measured; with 4 the whole takes some 7 minutes, with 60 half an hour. Default: ${DEFAULT-VALUE}.")
    private long seconds;

    @Option(
            names = "--report",
            paramLabel = "DIR",
            defaultValue = "target/evaluation",
            description = "Gets report.html, evaluation.md and images. Default: ${DEFAULT-VALUE}.")
    private Path report;

    @Option(
            names = "--results",
            paramLabel = "FILE",
            defaultValue = "target/evaluation/results.jsonl",
            description =
                    "Grows with each point; what it already holds of this commit is not measured again. Default: ${DEFAULT-VALUE}.")
    private Path results;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Files.createDirectories(results.toAbsolutePath().getParent());
        String commit = Checkout.here().name();
        EvaluationResults known = EvaluationResults.in(results);
        Calibration machine = Calibration.measure();
        out.println(machine.sentence());
        out.flush();
        new Evaluation(commit, Duration.ofSeconds(seconds), known, out).run(sweeps);
        new EvaluationReport(
                        known,
                        commit,
                        seconds,
                        List.of(
                                "Commit %s, each point %d s after a warm-up of 20 s for each sweep."
                                        .formatted(commit, seconds),
                                "Context broker, IoT Agent, MQTT broker and MongoDB are the embedded stand-ins; Kafka, Connect and Flink are real; sender,"
                                        + " suite and reader share one JVM and its processors.",
                                "At-least-once delivery, checkpoints each 10 s; the reader reads what is committed.",
                                machine.sentence()))
                .write(report);
        out.println("Report: " + report.resolve("report.html").toAbsolutePath());
        out.flush();
        return 0;
    }
}
