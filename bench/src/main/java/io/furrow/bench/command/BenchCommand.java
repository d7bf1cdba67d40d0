package io.furrow.bench.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.net.URI;
import java.net.http.HttpClient;
import java.net.http.HttpRequest;
import java.net.http.HttpResponse;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.List;
import java.util.Locale;
import java.util.function.Consumer;

import picocli.CommandLine;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;
import picocli.CommandLine.Spec;

import io.furrow.bench.load.LoadMeasurement;
import io.furrow.bench.load.LoadReport;
import io.furrow.bench.load.OverloadMeasurement;
import io.furrow.bench.load.OverloadReport;
import io.furrow.bench.mongo.MongoMeasurement;
import io.furrow.cli.option.HelpOption;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.flink.job.Delivery;
import io.furrow.flink.job.JobCommandLine;
import io.furrow.launcher.Furrow;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.launcher.suite.Suite;
import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.simulators.load.LoadPlan;

/** {@code ./furrow bench}. */
@Command(
        name = "bench",
        description = "Measures the suite on this machine.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = {
            NotificationBench.class,
            SinkBench.class,
            ImageBench.class,
            IngestBench.class,
            AnalyticsBench.class,
            ReplayBench.class,
            ControlBench.class,
            FleetBench.class,
            MissionBench.class,
            WholeBench.class,
            EvaluateBench.class,
            ComponentsBench.class,
            DashboardBench.class
        })
public final class BenchCommand {
    private static final String DOMAIN = "bench";
    /** A cold JVM cannot take what a warm one takes: it gets a quarter of the load, a half, then all of it. */
    private static final int WARM_UP_STEPS = 4;

    @Spec
    private CommandSpec spec;

    @Mixin
    private HelpOption help;

    public static void main(String... args) {
        System.setProperty("java.awt.headless", "true");
        System.exit(commandLine().execute(args));
    }

    static CommandLine commandLine() {
        return Furrow.commandLine()
                .addSubcommand(new BenchCommand())
                .registerConverter(Delivery.class, JobCommandLine::delivery);
    }

    @Command(
            name = "mongo",
            abbreviateSynopsis = true,
            description = "Writes events of a mission into MongoDB as the job ingest does, and in a bare loop around"
                    + " MongoDB's driver, by turns, and prints documents per second of both.")
    int mongo(
            @Option(
                            names = "--documents",
                            paramLabel = "N",
                            defaultValue = "50000",
                            description = "Documents a turn. Default: ${DEFAULT-VALUE}.")
                    int documents,
            @Option(
                            names = "--payload",
                            paramLabel = "BYTES",
                            defaultValue = "1000",
                            description = "Length of an event's JSON. Default: ${DEFAULT-VALUE}.")
                    int payload,
            @Option(
                            names = "--turns",
                            paramLabel = "N",
                            defaultValue = "5",
                            description = "Turns that count. Default: ${DEFAULT-VALUE}.")
                    int turns,
            @Option(
                            names = "--mongo",
                            paramLabel = "URI",
                            description =
                                    "MongoDB, whose database persistence is EMPTIED. Default: an embedded server in"
                                            + " memory.")
                    String uri,
            @Option(
                            names = {"-h", "--help"},
                            usageHelp = true,
                            description = "Show this text.")
                    boolean wantsHelp)
            throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        try (EmbeddedMongo embedded = uri == null ? EmbeddedMongo.inMemory() : null) {
            List<MongoMeasurement.Turn> all = new MongoMeasurement(
                            uri == null ? embedded.uri() : uri, documents, payload)
                    .run(turns, turn -> {
                        out.printf(
                                Locale.ROOT,
                                "  bare loop %,8.0f/s   sink writer %,8.0f/s   ratio %.2f%n",
                                turn.bare(),
                                turn.writer(),
                                turn.writer() / turn.bare());
                        out.flush();
                    });
            double ratio = all.stream()
                    .mapToDouble(turn -> turn.writer() / turn.bare())
                    .sorted()
                    .skip(turns / 2)
                    .findFirst()
                    .orElse(0);
            out.printf(Locale.ROOT, "median of the ratios: %.2f%n", ratio);
        }
        return 0;
    }

    @Command(
            name = "compare",
            abbreviateSynopsis = true,
            description =
                    "Says which components became faster or slower between two files of './furrow bench components', and which differences are noise.")
    int compare(
            @Parameters(paramLabel = "BEFORE", description = "A file of './furrow bench components'.") Path before,
            @Parameters(paramLabel = "NOW", description = "Another.") Path now,
            @Option(
                            names = {"-h", "--help"},
                            usageHelp = true,
                            description = "Show this text.")
                    boolean wantsHelp)
            throws IOException {
        ComponentsBench.compare(spec.commandLine().getOut(), before, now);
        return 0;
    }

    @Command(
            name = "load",
            abbreviateSynopsis = true,
            description =
                    "Sends the load of many devices over MQTT through the embedded suite and prints what arrived, and"
                            + " how long each hop took.")
    int load(
            @Option(
                            names = "--devices",
                            paramLabel = "N",
                            defaultValue = "625",
                            description = "Devices. Default: ${DEFAULT-VALUE}.")
                    int devices,
            @Option(
                            names = "--period",
                            paramLabel = "MS",
                            defaultValue = "1000",
                            description = "Milliseconds between two messages of a device. Default: ${DEFAULT-VALUE}.")
                    long period,
            @Option(
                            names = "--payload",
                            paramLabel = "BYTES",
                            defaultValue = "1000",
                            description = "Length of a message's payload. Default: ${DEFAULT-VALUE}.")
                    int payload,
            @Option(
                            names = "--seconds",
                            paramLabel = "S",
                            defaultValue = "60",
                            description = "How long to send. Default: ${DEFAULT-VALUE}.")
                    long seconds,
            @Option(
                            names = "--warmup",
                            paramLabel = "S",
                            defaultValue = "40",
                            description =
                                    "Seconds before it that are not counted: a quarter, half and all of the load. "
                                            + "Default: ${DEFAULT-VALUE}.")
                    long warmup,
            @Option(
                            names = "--skip",
                            paramLabel = "S",
                            defaultValue = "0",
                            description =
                                    "Of --seconds, those whose delays do not count; with --warmup 0 a cold start. "
                                            + "Default: ${DEFAULT-VALUE}.")
                    long skip,
            @Option(names = "--csv", paramLabel = "FILE", description = "Also write the figures here.") Path csv,
            @Option(
                            names = {"-h", "--help"},
                            usageHelp = true,
                            description = "Show this text.")
                    boolean wantsHelp)
            throws Exception {
        return onSuite((suite, progress) -> {
            LoadMeasurement measurement =
                    new LoadMeasurement(suite.devices(), suite.kafka().clientProperties(), progress);
            Duration between = Duration.ofMillis(period);
            for (int share = WARM_UP_STEPS; warmup > 0 && share >= 1; share /= 2) {
                measurement.run(new LoadPlan(
                        Math.max(1, devices / share),
                        between,
                        payload,
                        Duration.ofSeconds(Math.max(1, warmup / WARM_UP_STEPS)),
                        DOMAIN,
                        "warmup-" + share));
            }
            LoadReport report = measurement.run(
                    new LoadPlan(devices, between, payload, Duration.ofSeconds(seconds), DOMAIN, "load"),
                    Duration.ofSeconds(skip));
            report.print(spec.commandLine().getOut());
            if (csv != null) {
                Files.writeString(csv, report.csv());
            }
            return report.delivered() == report.sent() ? 0 : 1;
        });
    }

    @Command(
            name = "overload",
            abbreviateSynopsis = true,
            description =
                    "Sends the embedded suite a rate, half of it, twice as much and half of it again, and prints what arrived, and how"
                            + " what waited drained. Exit code 1 where a message is missing.")
    int overload(
            @Option(
                            names = "--rate",
                            paramLabel = "N",
                            defaultValue = "1250",
                            description =
                                    "Messages of 1 kB a second, a multiple of 5: the highest at which p99 stays below 1 s."
                                            + " Default: ${DEFAULT-VALUE}.")
                    int rate,
            @Option(
                            names = "--seconds",
                            paramLabel = "S",
                            defaultValue = "20",
                            description = "Of each rate. Default: ${DEFAULT-VALUE}.")
                    long seconds,
            @Option(
                            names = "--bursts",
                            description = "Twice the rate comes as four times the rate in every other second.")
                    boolean bursts,
            @Option(
                            names = {"-h", "--help"},
                            usageHelp = true,
                            description = "Show this text.")
                    boolean wantsHelp)
            throws Exception {
        return onSuite((suite, progress) -> {
            OverloadReport report = new OverloadMeasurement(
                            suite.devices(),
                            suite.kafka().clientProperties(),
                            () -> pending(suite.listener()),
                            new OverloadMeasurement.Plan(rate, Duration.ofSeconds(seconds), bursts),
                            progress)
                    .run();
            report.print(spec.commandLine().getOut());
            return report.delivered() == report.sent() ? 0 : 1;
        });
    }

    private interface Measurement {
        /** @return the exit code */
        int run(Suite suite, Consumer<String> progress) throws Exception;
    }

    private int onSuite(Measurement measurement) throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        try (RunDirectory directory = RunDirectory.open(null);
                Suite suite = Suite.start(SuiteSettings.onFreePorts("10s"), directory, new Progress(out))) {
            return measurement.run(suite, line -> {
                out.println("  " + line);
                out.flush();
            });
        }
    }

    private static long pending(URI listener) throws Exception {
        HttpRequest request =
                HttpRequest.newBuilder(listener.resolve("/health")).build();
        byte[] answer = HttpClient.newHttpClient()
                .send(request, HttpResponse.BodyHandlers.ofByteArray())
                .body();
        return NgsiJson.read(answer).required("pending").asLong();
    }
}
