package io.furrow.bench.notifications;

import java.net.InetSocketAddress;
import java.nio.file.Files;
import java.nio.file.Path;
import java.time.Duration;
import java.util.ArrayList;
import java.util.HashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.ExecutionException;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.OutputOption;
import io.furrow.bench.http.HttpLoad;
import io.furrow.embedded.FreePort;
import io.furrow.launcher.suite.Connectors;
import io.furrow.launcher.suite.Suite;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench notifications}. */
@Command(
        name = "notifications",
        description = {
            "Loads the NGSI source with notifications as Orion sends them and counts those that were "
                    + "acknowledged and are in Kafka.",
            "Kafka, the Connect worker, the senders and the reader that checks run in this one process. Beside "
                    + "each run the same load goes to an HTTP server that only answers and to one that forwards to Kafka, "
                    + "and a producer writes the same records, so that figures of different machines can be compared by "
                    + "their shares.",
            "Exit code 0 means that no acknowledged notification is missing."
        })
public final class NotificationBench extends Benchmark {
    private static final int FIRST_RATE = 1_000;

    @Option(
            names = "--connections",
            paramLabel = "N",
            description = "Notifications that can be on their way at a time. " + DEFAULT)
    private int connections = 64;

    @Option(
            names = "--new-connections",
            description = "Connect anew for each notification, as Orion does unless configured otherwise.")
    private boolean newConnections;

    @Option(
            names = "--rate",
            paramLabel = "N",
            description = {
                "Notifications per second that are due whether or not earlier ones were answered; delays count from when a"
                        + " notification was due.",
                "0 sends the next as soon as one is answered. " + DEFAULT
            })
    private int rate;

    @Option(names = "--payload", paramLabel = "BYTES", description = "Length of a body, at least 500. " + DEFAULT)
    private int payload = 1000;

    @Option(names = "--entities", paramLabel = "N", description = "Different entities. " + DEFAULT)
    private int entities = 1000;

    @Option(names = "--seconds", paramLabel = "S", description = "Length of a run. " + DEFAULT)
    private int seconds = 15;

    @Option(names = "--runs", paramLabel = "N", description = "Runs, of which the median is shown. " + DEFAULT)
    private int runs = 5;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            description = "Seconds of load before the first run that are not counted. " + DEFAULT)
    private int warmup = 20;

    @Option(
            names = "--calibration",
            paramLabel = "S",
            description = "Seconds for each of bare server, bare bridge and bare producer, each run. " + DEFAULT)
    private int calibration = 5;

    @Option(
            names = "--whole",
            description = {
                "Load a whole suite: entities of one mission, read at the mission's topic. A rate is held if all "
                        + "events arrive once and 99 of 100 within a second of their receipt.",
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

    @Mixin
    private final OutputOption output = new OutputOption();

    @Override
    public Integer call() throws Exception {
        if (whole) {
            return onSuite(data, this::pressSuite);
        }
        try (Engines engines = Engines.in(data, out()).kafka()) {
            Connectors connectors =
                    engines.connect(exactlyOnce ? Map.of("exactly.once.source.support", "enabled") : Map.of());
            Path journal = engines.folder("journal");
            // In memory, for instance, an fsync costs nothing, and the figures would be meaningless.
            String place =
                    journal + ", on " + Files.getFileStore(journal.getParent()).type();
            NotificationReport report =
                    new NotificationReport(at(rate, seconds), place, measure(engines, connectors, journal));
            report.print(out());
            output.write(report.json());
            return report.missing() == 0 ? 0 : 1;
        }
    }

    private int pressSuite(Suite suite) throws InterruptedException, ExecutionException {
        SuiteLoad load = new SuiteLoad(suite, entities);
        load.run(at(FIRST_RATE, warmup));
        Figures figures = new Figures("");
        SuiteLoad.Run run;
        int next = rate > 0 ? rate : FIRST_RATE;
        do {
            run = load.run(at(next, seconds));
            say("%d per second: p99 %.0f ms".formatted(next, run.millis(99)));
            figures.add(
                    "rate", next,
                    "answered", run.load().answered(),
                    "missing", run.missing(),
                    "repeats", run.repeats(),
                    "refused", run.load().refused() + run.load().broken(),
                    "p50 ms", run.millis(50),
                    "p99 ms", run.millis(99),
                    "max ms", run.millis(100),
                    "", run.isHeld() ? "held" : "not held");
            next += next / 4;
        } while (rate == 0 && run.isHeld());
        print(figures);
        return run.missing() == 0 ? 0 : 1;
    }

    private HttpLoad.Plan at(int perSecond, int lasting) {
        return new HttpLoad.Plan(
                connections, newConnections, perSecond, payload, entities, Duration.ofSeconds(lasting));
    }

    private List<NotificationReport.Run> measure(Engines engines, Connectors connectors, Path journal)
            throws Exception {
        InetSocketAddress source = new InetSocketAddress("127.0.0.1", FreePort.orFree(0));
        Duration peers = Duration.ofSeconds(calibration);
        List<NotificationReport.Run> all = new ArrayList<>();
        try (NotificationMeasurement measurement =
                new NotificationMeasurement(source, Topics.RAW, engines.client(), this::say)) {
            measurement.makeTopics();
            connectors.put("bench", settings(source, journal));
            if (warmup > 0) {
                measurement.run("warm-up", at(rate, warmup), peers);
            }
            for (int run = 1; run <= runs; run++) {
                all.add(measurement.run("run " + run, at(rate, seconds), peers));
            }
        }
        return all;
    }

    private Map<String, String> settings(InetSocketAddress source, Path journal) {
        Map<String, String> settings = new HashMap<>();
        settings.put("connector.class", "io.furrow.connect.source.NgsiSourceConnector");
        settings.put("tasks.max", "1");
        settings.put("topic", Topics.RAW);
        settings.put("listen.port", Integer.toString(source.getPort()));
        settings.put("journal.dir", journal.toString());
        if (exactlyOnce) {
            settings.put("exactly.once.support", "required");
        }
        settings.putAll(connectorOptions);
        return settings;
    }
}
