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
                "Repeats the evaluation of the WeLASER platform: devices send four sweeps of load to a suite, then double "
                        + "the load until it does not hold. Reports loss, delay, duplicates and order at a reader as a page "
                        + "with plots. An interrupted run continues.")
public final class EvaluateBench extends Benchmark {
    private static final long SHORT_SECONDS = 3;
    private static final List<String> EMBEDDED = List.of(
            "Context broker, IoT Agent, MQTT broker and MongoDB are the embedded stand-ins. Kafka, Connect and Flink are real. Sender,"
                    + " suite and reader share one JVM.",
            "Like Orion, the stand-in of the context broker sends each notification once, those of one entity in order. It drops"
                    + " notifications beyond 20,000 that wait.",
            "At-least-once delivery, a checkpoint every 10 s; the reader reads committed records.");

    @Option(
            names = "--sweeps",
            paramLabel = "SWEEP",
            split = ",",
            defaultValue = "PERIOD,DEVICES,PAYLOAD,SUBSCRIPTIONS",
            description = "Sweeps to measure: ${COMPLETION-CANDIDATES}. Default: all.")
    private List<Sweep> sweeps;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            description = "Duration of each point; with 60, all sweeps take some 45 minutes. " + DEFAULT)
    private long seconds = 60;

    @Option(
            names = "--short",
            description = "Takes some 5 minutes: 3 s per point, one suite for all sweeps, as with --no-knee.")
    private boolean isShort;

    @Option(
            names = "--no-knee",
            description = "Stop after the last point of each sweep. Default: double the load until it does not hold.")
    private boolean noKnee;

    @Mixin
    private DeploymentOptions deployment;

    @Option(
            names = "--report",
            paramLabel = "DIR",
            description = "Folder for report.html, evaluation.md and images. " + DEFAULT)
    private Path report = Path.of("target/evaluation");

    @Option(
            names = "--results",
            paramLabel = "FILE",
            description =
                    "Each point is appended. Points already measured for this commit, heap and duration are not measured again. "
                            + DEFAULT)
    private Path results = Path.of("target/evaluation/results.jsonl");

    @Override
    public Integer call() throws Exception {
        Files.createDirectories(results.toAbsolutePath().getParent());
        long duration = isShort ? SHORT_SECONDS : seconds;
        EvaluationResults stored = EvaluationResults.in(results);
        Calibration machine = Calibration.measure();
        print("%s%n", machine.sentence());
        Evaluation.Target target = deployment.target();
        EvaluationResults.Run run =
                new EvaluationResults.Run(suite(), target == null ? Calibration.maxHeap() : 0, duration);
        new Evaluation(new Evaluation.Plan(sweeps, run, !noKnee && !isShort, isShort, target), stored, out()).run();
        List<String> setting =
                new ArrayList<>(List.of("Version %s; %d s per point, after a warm-up of 20 s per suite%s."
                        .formatted(
                                run.commit(),
                                duration,
                                isShort ? "" : "; points beyond those of the thesis at most 20 s")));
        setting.addAll(target == null ? EMBEDDED : deployment.setting(target.devices()));
        setting.add(machine.sentence());
        new EvaluationReport(stored, run, setting).write(report);
        print("Report: %s%n", report.resolve("report.html").toAbsolutePath());
        return 0;
    }

    /** The commit of the checkout, or the release of an archive. */
    private String suite() throws IOException {
        return Files.exists(Path.of(System.getProperty("furrow.home"), ".git"))
                ? Checkout.here().name()
                : spec().root().version()[0];
    }
}
