package io.furrow.bench.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.net.InetSocketAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.concurrent.Callable;
import java.util.concurrent.ExecutionException;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.http.HttpLoadPlan;
import io.furrow.bench.notifications.NotificationMeasurement;
import io.furrow.bench.notifications.NotificationReport;
import io.furrow.bench.notifications.NotificationRun;
import io.furrow.bench.notifications.SuiteLoad;
import io.furrow.cli.option.HelpOption;
import io.furrow.embedded.FreePort;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench notifications}. */
@Command(
        name = "notifications",
        abbreviateSynopsis = true,
        description = {
            "Presses the NGSI source with notifications as Orion sends them and counts those that were acknowledged and are"
                    + " in Kafka.",
            "Kafka, the Connect worker, the senders and the reader that checks run in this one process. Beside each run the"
                    + " same load goes to an HTTP server that only answers and to one that forwards to Kafka, and a producer"
                    + " writes the same records, so that"
                    + " figures of different machines can be compared by their shares.",
            "Exit code 0 means that no acknowledged notification is missing."
        })
final class NotificationBench implements Callable<Integer> {
    private static final int FIRST_RATE = 1_000;
    private static final String SUITE_HEAD = "%8s %9s %8s %8s %8s %8s %8s %8s  %s%n";
    private static final String SUITE_LINE = "%8d %9d %8d %8d %8d %8.0f %8.0f %8.0f  %s%n";

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--connections",
            paramLabel = "N",
            defaultValue = "64",
            description = "Notifications that can be on their way at a time. Default: ${DEFAULT-VALUE}.")
    private int connections;

    @Option(
            names = "--new-connections",
            description = "Connect anew for each notification, as Orion does unless configured otherwise.")
    private boolean newConnections;

    @Option(
            names = "--rate",
            paramLabel = "N",
            defaultValue = "0",
            description = {
                "Notifications per second that are due whether or not earlier ones were answered; delays count from when a"
                        + " notification was due.",
                "0 sends the next as soon as one is answered. Default: ${DEFAULT-VALUE}."
            })
    private int rate;

    @Option(
            names = "--payload",
            paramLabel = "BYTES",
            defaultValue = "1000",
            description = "Length of a body, at least 500. Default: ${DEFAULT-VALUE}.")
    private int payload;

    @Option(
            names = "--entities",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Different entities. Default: ${DEFAULT-VALUE}.")
    private int entities;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "15",
            description = "Length of a run. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    @Option(
            names = "--runs",
            paramLabel = "N",
            defaultValue = "5",
            description = "Runs, of which the median is shown. Default: ${DEFAULT-VALUE}.")
    private int runs;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            defaultValue = "20",
            description = "Seconds of load before the first run that are not counted. Default: ${DEFAULT-VALUE}.")
    private int warmup;

    @Option(
            names = "--calibration",
            paramLabel = "S",
            defaultValue = "5",
            description =
                    "Seconds for each of bare server, bare bridge and bare producer, each run. Default: ${DEFAULT-VALUE}.")
    private int calibration;

    @Option(
            names = "--whole",
            description = {
                "Press a whole suite: entities of one mission, read at the mission's topic. Held is a rate of which all"
                        + " arrives once, 99 of 100 within a second of their receipt.",
                "Without --rate from 1000 a second on a quarter more each time, until one is not held."
            })
    private boolean whole;

    @Option(names = "--exactly-once", description = "Let Connect write in transactions.")
    private boolean exactlyOnce;

    @Option(
            names = "--connector",
            paramLabel = "OPTION=VALUE",
            description = "An option of the connector, for instance --connector journal.segment.bytes=1000000.")
    private Map<String, String> connectorOptions = new HashMap<>();

    @Option(
            names = "--data",
            paramLabel = "DIR",
            description = "Keep Kafka's log and the journal here, on the disk to be measured. Default: a temporary"
                    + " directory that is deleted at the end.")
    private Path data;

    @Option(names = "--output", paramLabel = "FILE", description = "Also write every figure here, as JSON.")
    private Path output;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        if (whole) {
            return pressSuite(out);
        }
        Map<String, String> worker = exactlyOnce ? Map.of("exactly.once.source.support", "enabled") : Map.of();
        try (RunDirectory directory = RunDirectory.open(data);
                BenchCluster cluster = BenchCluster.start(directory, worker, new Progress(out))) {
            Path journal = directory.resolve("journal");
            NotificationReport report =
                    new NotificationReport(plan(), fileSystem(directory, journal), measure(cluster, journal, out));
            report.print(out);
            if (output != null) {
                Files.write(output, NgsiJson.write(report.json()));
            }
            return report.missing() == 0 ? 0 : 1;
        }
    }

    private int pressSuite(PrintWriter out) throws Exception {
        try (RunDirectory directory = RunDirectory.open(data);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out))) {
            SuiteLoad load = new SuiteLoad(suite, entities);
            out.printf(
                    SUITE_HEAD, "rate", "answered", "missing", "repeats", "refused", "p50 ms", "p99 ms", "max ms", "");
            load.run(at(FIRST_RATE).lasting(Duration.ofSeconds(warmup)));
            SuiteLoad.Run run;
            int next = rate > 0 ? rate : FIRST_RATE;
            do {
                run = load.run(at(next));
                out.printf(
                        Locale.ROOT,
                        SUITE_LINE,
                        next,
                        run.load().answered(),
                        run.missing(),
                        run.repeats(),
                        run.load().refused() + run.load().broken(),
                        run.millis(50),
                        run.millis(99),
                        run.millis(100),
                        run.isHeld() ? "held" : "not held");
                out.flush();
                next += next / 4;
            } while (rate == 0 && run.isHeld());
            return run.missing() == 0 ? 0 : 1;
        }
    }

    private HttpLoadPlan at(int perSecond) {
        return new HttpLoadPlan(connections, newConnections, perSecond, payload, entities, Duration.ofSeconds(seconds));
    }

    private List<NotificationRun> measure(BenchCluster cluster, Path journal, PrintWriter out)
            throws InterruptedException, ExecutionException {
        InetSocketAddress source = new InetSocketAddress("127.0.0.1", FreePort.orFree(0));
        try (NotificationMeasurement measurement =
                new NotificationMeasurement(source, Topics.RAW, cluster.kafka(), line -> {
                    out.println("  " + line);
                    out.flush();
                })) {
            measurement.makeTopics();
            cluster.connectors().put("bench", settings(source, journal));
            return run(measurement);
        }
    }

    private List<NotificationRun> run(NotificationMeasurement measurement) throws InterruptedException {
        if (warmup > 0) {
            measurement.run("warm-up", plan().lasting(Duration.ofSeconds(warmup)), Duration.ofSeconds(calibration));
        }
        List<NotificationRun> all = new ArrayList<>();
        for (int run = 1; run <= runs; run++) {
            all.add(measurement.run("run " + run, plan(), Duration.ofSeconds(calibration)));
        }
        return all;
    }

    private HttpLoadPlan plan() {
        return at(rate);
    }

    private Map<String, String> settings(InetSocketAddress source, Path journal) {
        Map<String, String> settings = new HashMap<>(Map.of(
                "connector.class",
                "io.furrow.connect.source.NgsiSourceConnector",
                "tasks.max",
                "1",
                "topic",
                Topics.RAW,
                "listen.port",
                Integer.toString(source.getPort()),
                "journal.dir",
                journal.toString()));
        if (exactlyOnce) {
            settings.put("exactly.once.support", "required");
        }
        settings.putAll(connectorOptions);
        return settings;
    }

    /** In memory, for instance, an fsync costs nothing, and the figures would say nothing. */
    private static String fileSystem(RunDirectory directory, Path journal) throws IOException {
        return journal + ", on " + Files.getFileStore(directory.path()).type();
    }
}
