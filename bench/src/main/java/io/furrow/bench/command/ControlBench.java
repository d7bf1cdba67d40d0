package io.furrow.bench.command;

import java.io.PrintWriter;
import java.time.Clock;
import java.time.Duration;
import java.util.Properties;
import java.util.UUID;
import java.util.concurrent.Callable;

import org.apache.kafka.clients.producer.KafkaProducer;
import org.apache.kafka.clients.producer.ProducerRecord;
import org.apache.kafka.common.serialization.ByteArraySerializer;
import org.apache.kafka.common.serialization.StringSerializer;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.bench.control.ControlClient;
import io.furrow.bench.control.ControlLoadPlan;
import io.furrow.bench.control.ControlMeasurement;
import io.furrow.bench.control.ControlReport;
import io.furrow.bench.control.ControlRequest;
import io.furrow.bench.control.KafkaControlClient;
import io.furrow.bench.control.RestControlClient;
import io.furrow.cli.option.HelpOption;
import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.readiness.Readiness;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.process.Sleep;
import io.furrow.launcher.suite.Closeables;
import io.furrow.launcher.suite.RunDirectory;
import io.furrow.model.control.DomainCommand;
import io.furrow.model.control.DomainDetails;
import io.furrow.model.control.Requests;
import io.furrow.model.topic.Topics;

/** {@code ./furrow bench control}. */
@Command(
        name = "control",
        abbreviateSynopsis = true,
        description = {
            "Asks the managers of domains and missions, over Kafka and over REST, and counts the answers.",
            "Each way is measured as fast as requests are answered, then at a rate; delays count from when a request was due."
                    + " Kafka, the managers and the clients run in this one process.",
            "Exit code 0 means that each request was answered once, as it should be."
        })
final class ControlBench implements Callable<Integer> {
    private static final int POLLS = 600;
    private static final Duration POLL_INTERVAL = Duration.ofMillis(100);

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--rate",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Requests per second of the second part. Default: ${DEFAULT-VALUE}.")
    private int rate;

    @Option(
            names = "--outstanding",
            paramLabel = "N",
            defaultValue = "1000",
            description = "Requests that may wait for their answer at a time, at most " + ControlRequest.OUTSTANDING
                    + ". Default: ${DEFAULT-VALUE}.")
    private int outstanding;

    @Option(
            names = "--seconds",
            paramLabel = "S",
            defaultValue = "20",
            description = "Length of each load. Default: ${DEFAULT-VALUE}.")
    private int seconds;

    @Option(
            names = "--warmup",
            paramLabel = "S",
            defaultValue = "10",
            description = "Seconds of load before, of each way, that are not counted. Default: ${DEFAULT-VALUE}.")
    private int warmup;

    @Mixin
    private HelpOption help;

    private boolean sound = true;

    @Override
    public Integer call() throws Exception {
        PrintWriter out = spec.commandLine().getOut();
        Progress progress = new Progress(out);
        try (RunDirectory directory = RunDirectory.open(null);
                Closeables parts = directory.closingFirst(new Closeables())) {
            LogFile.writeTo(directory.resolve("furrow.log"));
            EmbeddedKafka kafka =
                    parts.add("Kafka", progress.step("Kafka", () -> EmbeddedKafka.start(directory.resolve("kafka"))));
            Properties client = new Properties();
            client.setProperty("bootstrap.servers", kafka.bootstrapServers());
            client.setProperty("state.dir", directory.resolve("state").toString());
            ControlSettings settings = ControlSettings.of(client);
            ControlPlane plane = parts.add("managers", progress.step("managers", () -> ControlPlane.start(settings)));
            RestApi api = parts.add(
                    "REST",
                    progress.step(
                            "REST",
                            () -> RestApi.start(settings, RestSettings.on(0), new Readiness(Clock.systemUTC()))));
            makeDomains(client);
            for (int i = 0; i < POLLS && !(plane.isHealthy() && api.isReady()); i++) {
                Sleep.of(POLL_INTERVAL);
            }
            ControlReport.header(out);
            measure("Kafka", new KafkaControlClient(client), out);
            measure("REST", new RestControlClient(api.uri()), out);
        }
        return sound ? 0 : 1;
    }

    private void measure(String way, ControlClient client, PrintWriter out) throws InterruptedException {
        try (client) {
            ControlMeasurement measurement =
                    new ControlMeasurement(client, UUID.randomUUID().toString().substring(0, 8));
            if (warmup > 0) {
                measurement.run(new ControlLoadPlan(0, outstanding, Duration.ofSeconds(warmup)));
            }
            report(way + ", as fast as answered", measurement.run(plan(0)), out);
            report(way + ", " + rate + "/s", measurement.run(plan(rate)), out);
        }
    }

    private ControlLoadPlan plan(int perSecond) {
        int most = perSecond == 0 ? Math.min(outstanding, ControlRequest.OUTSTANDING) : ControlRequest.OUTSTANDING;
        return new ControlLoadPlan(perSecond, most, Duration.ofSeconds(seconds));
    }

    private void report(String name, ControlReport report, PrintWriter out) {
        report.print(name, out);
        sound &= report.isSound();
    }

    private static void makeDomains(Properties client) {
        try (KafkaProducer<String, byte[]> producer =
                new KafkaProducer<>(client, new StringSerializer(), new ByteArraySerializer())) {
            for (int i = 0; i < ControlRequest.DOMAINS; i++) {
                producer.send(new ProducerRecord<>(
                        Topics.DOMAIN_MANAGER,
                        Requests.write(null, new DomainCommand.Create("bench-" + i, DomainDetails.NONE))));
            }
        }
    }
}
