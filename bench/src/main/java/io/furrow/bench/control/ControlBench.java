package io.furrow.bench.control;

import java.time.Clock;
import java.time.Duration;
import java.util.Map;
import java.util.Properties;
import java.util.UUID;

import org.apache.kafka.clients.producer.ProducerRecord;
import picocli.CommandLine.Command;
import picocli.CommandLine.Option;

import io.furrow.bench.frame.Benchmark;
import io.furrow.bench.frame.Engines;
import io.furrow.bench.frame.Figures;
import io.furrow.bench.frame.TopicFiller;
import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.kafka.Readiness;
import io.furrow.launcher.process.Sleep;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench control}. */
@Command(
        name = "control",
        description = {
            "Sends requests to the managers of domains and missions over Kafka and REST and counts the answers.",
            "Each way is measured as fast as requests are answered, then at a rate; delays count from when a "
                    + "request was due. Kafka, the managers and the clients run in this one process.",
            "Exit code 0 means that each request was answered once, as it should be."
        })
public final class ControlBench extends Benchmark {
    private static final int POLLS = 600;
    private static final Duration POLL_INTERVAL = Duration.ofMillis(100);

    @Option(names = "--rate", paramLabel = "N", description = "Requests per second of the second part. " + DEFAULT)
    private int rate = 1000;

    @Option(
            names = "--outstanding",
            paramLabel = "N",
            description = "Requests that may wait for their answer at a time, at most " + ControlRequest.OUTSTANDING
                    + ". " + DEFAULT)
    private int outstanding = 1000;

    @Option(names = "--seconds", paramLabel = "S", description = "Length of each load. " + DEFAULT)
    private int seconds = 20;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            description = "Seconds of load before, of each way, that are not counted. " + DEFAULT)
    private int warmup = 10;

    private final Figures figures = new Figures("");
    private boolean sound = true;

    @Override
    public Integer call() throws Exception {
        try (Engines engines = Engines.in(null, out()).kafka()) {
            Properties client = engines.client();
            client.setProperty("state.dir", engines.folder("state").toString());
            ControlSettings settings = ControlSettings.of(client);
            ControlPlane plane = engines.start("managers", () -> ControlPlane.start(settings));
            RestApi api = engines.start(
                    "REST", () -> RestApi.start(settings, RestSettings.on(0), new Readiness(Clock.systemUTC())));
            makeDomains(client);
            for (int i = 0; i < POLLS && !(plane.isHealthy() && api.isReady()); i++) {
                Sleep.of(POLL_INTERVAL);
            }
            measure("Kafka", new KafkaControlClient(client));
            measure("REST", new RestControlClient(api.uri()));
        }
        print(figures);
        return sound ? 0 : 1;
    }

    private void measure(String way, ControlClient client) throws InterruptedException {
        try (client) {
            ControlMeasurement measurement =
                    new ControlMeasurement(client, UUID.randomUUID().toString().substring(0, 8));
            if (warmup > 0) {
                measurement.run(new ControlMeasurement.Plan(0, outstanding, Duration.ofSeconds(warmup)));
            }
            report(way + ", as fast as answered", measurement.run(plan(0)));
            report(way + ", " + rate + "/s", measurement.run(plan(rate)));
        }
    }

    private ControlMeasurement.Plan plan(int perSecond) {
        int most = perSecond == 0 ? Math.min(outstanding, ControlRequest.OUTSTANDING) : ControlRequest.OUTSTANDING;
        return new ControlMeasurement.Plan(perSecond, most, Duration.ofSeconds(seconds));
    }

    private void report(String name, ControlMeasurement.Report report) {
        say("%s: %.0f answered a second".formatted(name, report.perSecond()));
        report.addTo(figures, name);
        sound &= report.isSound();
    }

    private static void makeDomains(Properties client) {
        try (TopicFiller filler = new TopicFiller(client, Map.of())) {
            for (int i = 0; i < ControlRequest.DOMAINS; i++) {
                byte[] request = Requests.write(null, new DomainCommand.Create("bench-" + i, DomainDetails.NONE));
                filler.send(new ProducerRecord<>(Topics.DOMAIN_MANAGER, request));
            }
        }
    }
}
