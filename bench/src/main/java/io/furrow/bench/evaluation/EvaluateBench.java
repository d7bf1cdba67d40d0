package io.furrow.bench.evaluation;

import java.io.IOException;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.whole.Checkout;

/** {@code ./furrow bench evaluate}. */
@Command(
        name = "evaluate",
        description =
                "Repeats the evaluation of the WeLASER platform: sends four sweeps of load at the devices' end of a "
                        + "suite, then twice and twice again as much until it does not hold, and reports what arrived at a "
                        + "reader, how late, twice or out of order, in a page with plots. An interrupted run continues.")
public final class EvaluateBench extends Benchmark {
    private static final long SHORT_SECONDS = 3;
    private static final List<String> EMBEDDED = List.of(
            "Context broker, IoT Agent, MQTT broker and MongoDB are the embedded stand-ins; Kafka, Connect and Flink are real; sender,"
                    + " suite and reader share one JVM and its processors.",
            "The stand-in of the context broker, like Orion, sends each notification once, those of an entity one after the other; what"
                    + " exceeds 20,000 that wait it drops.",
            "At-least-once delivery, checkpoints each 10 s; the reader reads what is committed.");

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
            description = "How long each point is measured; with 60 all of it takes some 45 minutes. " + DEFAULT)
    private long seconds = 60;

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
            description = "Gets report.html, evaluation.md and images. " + DEFAULT)
    private Path report = Path.of("target/evaluation");

    @Option(
            names = "--results",
            paramLabel = "FILE",
            description =
                    "Grows with each point; what it already holds of this commit, with the same heap, is not measured again. "
                            + DEFAULT)
    private Path results = Path.of("target/evaluation/results.jsonl");

    @Override
    public Integer call() throws Exception {
        Files.createDirectories(results.toAbsolutePath().getParent());
        long lasting = isShort ? SHORT_SECONDS : seconds;
        EvaluationResults known = EvaluationResults.in(results);
        Calibration machine = Calibration.measure();
        print("%s%n", machine.sentence());
        Evaluation.Target target = deployment.target();
        EvaluationResults.Run run =
                new EvaluationResults.Run(suite(), target == null ? Calibration.maxHeap() : 0, lasting);
        new Evaluation(new Evaluation.Plan(sweeps, run, !noKnee && !isShort, isShort, target), known, out()).run();
        List<String> setting = new ArrayList<>(List.of("%s; each point %d s, after a warm-up of 20 s for each suite%s."
                .formatted(run.commit(), lasting, isShort ? "" : "; points beyond those of the thesis at most 20 s")));
        setting.addAll(target == null ? EMBEDDED : deployment.setting(target.devices()));
        setting.add(machine.sentence());
        new EvaluationReport(known, run, setting).write(report);
        print("Report: %s%n", report.resolve("report.html").toAbsolutePath());
        return 0;
    }

    /** The suite's commit; of an archive its release. */
    private String suite() throws IOException {
        return Files.exists(Path.of(System.getProperty("furrow.home"), ".git"))
                ? Checkout.here().name()
                : spec().root().version()[0];
    }
}
