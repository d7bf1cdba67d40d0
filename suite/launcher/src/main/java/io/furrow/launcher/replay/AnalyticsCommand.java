package io.furrow.launcher.replay;

import java.io.PrintWriter;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;

import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.HttpUriConverter;
import io.furrow.cli.option.KafkaClient;
import io.furrow.launcher.process.ClockWatch;
import io.furrow.launcher.process.LogFile;
import io.furrow.model.topic.Topics;

/** {@code ./furrow replay analytics}. */
@Command(
        name = "analytics",
        abbreviateSynopsis = true,
        description =
                "Runs the analytics jobs of replays on a Flink cluster and cancels them at the end of their replays, "
                        + "until Ctrl-C; jobs then continue, and the next start finds them. ./furrow demo and up do this on "
                        + "their own Flink.")
public final class AnalyticsCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--flink-url",
            paramLabel = "URL",
            required = true,
            converter = HttpUriConverter.class,
            description = "REST API of the cluster, for instance http://jobmanager:8081. It must accept jars: "
                    + "web.submit.enable.")
    private URI flink;

    @Option(
            names = "--jar",
            paramLabel = "FILE",
            required = true,
            description = "The job jar of analytics, analytics/target/furrow-analytics-*-job.jar. Uploaded once.")
    private Path jar;

    @Option(
            names = {"--kafka", "--bootstrap-servers"},
            paramLabel = "HOST:PORT",
            description = "Kafka, as reached by this command and the cluster. Default: ${DEFAULT-VALUE}.")
    private String kafka = "127.0.0.1:9092";

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka clients, here and, under the same path, on the cluster.")
    private Path kafkaProperties;

    @Option(
            names = "--option",
            paramLabel = "--NAME=VALUE",
            description =
                    "One more option for every job, for instance --option=--parallelism=2. May be given several times.")
    private List<String> options = List.of();

    @Option(
            names = "--elastic",
            description = "Start jobs even if no slot is free, because the cluster starts task managers on demand.")
    private boolean elastic;

    @Option(names = "--log", paramLabel = "FILE", description = "Where to log. Default: ${DEFAULT-VALUE}.")
    private Path log = Path.of("/dev/stderr");

    @Override
    public Integer call() throws InterruptedException {
        if (!Files.isReadable(jar)) {
            throw new ParameterException(
                    spec.commandLine(), "--jar " + jar + " cannot be read; ./mvnw -pl analytics -am package makes it");
        }
        LogFile.writeTo(log);
        List<String> all = new ArrayList<>(List.of("--bootstrap-servers", kafka));
        if (kafkaProperties != null) {
            all.addAll(List.of("--kafka-properties", kafkaProperties.toString()));
        }
        all.addAll(options);
        ClusterAnalytics executor = new ClusterAnalytics(new FlinkRest(flink), jar, all, elastic);
        CountDownLatch stop = new CountDownLatch(1);
        Runtime.getRuntime().addShutdownHook(new Thread(stop::countDown, "stop"));
        ReplayAnalytics analytics = ReplayAnalytics.start(KafkaClient.settings(kafka, kafkaProperties), executor);
        try {
            PrintWriter out = spec.commandLine().getOut();
            out.println("Follows " + Topics.REPLAYS + " at " + kafka + "; Ctrl-C stops it, jobs stay.");
            out.flush();
            new ClockWatch().await(stop);
            return 0;
        } finally {
            analytics.close();
        }
    }
}
