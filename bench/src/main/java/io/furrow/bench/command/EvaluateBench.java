package io.furrow.bench.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
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
import io.furrow.bench.evaluation.Target;
import io.furrow.bench.whole.Checkout;
import io.furrow.cli.option.HelpOption;

/** {@code ./furrow bench evaluate}. */
@Command(
        name = "evaluate",
        abbreviateSynopsis = true,
        description =
                "Repeats the evaluation of the WeLASER platform: sends four sweeps of load at the devices' end of a suite, then twice and twice"
                        + " again as much until it does not hold, and reports what arrived at a reader, how late, twice or out of order, in a"
                        + " page with plots. One that was interrupted goes on where it was.")
final class EvaluateBench implements Callable<Integer> {
    private static final long SHORT_SECONDS = 3;

    private static final List<String> EMBEDDED = List.of(
            "Context broker, IoT Agent, MQTT broker and MongoDB are the embedded stand-ins; Kafka, Connect and Flink are real; sender,"
                    + " suite and reader share one JVM and its processors.",
            "The stand-in of the context broker, like Orion, sends each notification once, those of an entity one after the other; what"
                    + " exceeds 20,000 that wait it drops.",
            "At-least-once delivery, checkpoints each 10 s; the reader reads what is committed.");

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
                    "How long each point is measured; with 60 all of it takes some 45 minutes. Default: ${DEFAULT-VALUE}.")
    private long seconds;

    @Option(
            names = "--short",
            description = "Some 5 minutes: 3 s a point, one suite for all sweeps, no way to the knee.")
    private boolean isShort;

    @Option(
            names = "--no-knee",
            description = "Not beyond the last point of each sweep. Default: twice the load, until it does not hold.")
    private boolean noKnee;

    @Mixin
    private DeploymentOptions deployment;

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
                    "Grows with each point; what it already holds of this commit, with the same heap, is not measured again. Default: ${DEFAULT-VALUE}.")
    private Path results;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Files.createDirectories(results.toAbsolutePath().getParent());
        long seconds = isShort ? SHORT_SECONDS : this.seconds;
        EvaluationResults known = EvaluationResults.in(results);
        Calibration machine = Calibration.measure();
        out.println(machine.sentence());
        out.flush();
        Target target = deployment.target();
        EvaluationResults.Run run =
                new EvaluationResults.Run(suite(), target == null ? Calibration.maxHeap() : 0, seconds);
        new Evaluation(new Evaluation.Plan(sweeps, run, !noKnee && !isShort, isShort, target), known, out).run();
        List<String> setting = new ArrayList<>(List.of("%s; each point %d s, after a warm-up of 20 s for each suite%s."
                .formatted(run.commit(), seconds, isShort ? "" : "; points beyond those of the thesis at most 20 s")));
        setting.addAll(target == null ? EMBEDDED : deployment.setting(target.devices()));
        setting.add(machine.sentence());
        new EvaluationReport(known, run, setting).write(report);
        out.println("Report: " + report.resolve("report.html").toAbsolutePath());
        out.flush();
        return 0;
    }

    /** Its commit, of an archive its release. */
    private String suite() throws IOException {
        return Files.exists(Path.of(System.getProperty("furrow.home"), ".git"))
                ? Checkout.here().name()
                : spec.root().version()[0];
    }
}
