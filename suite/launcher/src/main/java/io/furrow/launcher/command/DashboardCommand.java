package io.furrow.launcher.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.net.InetAddress;
import java.net.URI;
import java.net.UnknownHostException;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;
import java.util.concurrent.CountDownLatch;
import java.util.concurrent.TimeUnit;

import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ParameterException;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.option.HttpUriConverter;
import io.furrow.cli.option.KafkaClient;
import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.launcher.option.AccessFlags;
import io.furrow.launcher.option.TileFlags;
import io.furrow.launcher.option.TrustedProxyFlags;
import io.furrow.launcher.process.ClockWatch;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.suite.PortCheck;
import io.furrow.launcher.suite.ServerCheck;
import io.furrow.model.topic.TopicRules;

/** {@code ./furrow dashboard}. */
@Command(
        name = "dashboard",
        abbreviateSynopsis = true,
        description =
                "Serves the page of the farm and, under the same origin, topics as WebSockets and server-sent events "
                        + "and the control plane's REST API. Uses an existing Kafka and control plane.")
public final class DashboardCommand implements Callable<Integer> {
    private static final long STOPPED_WITHIN_SECONDS = 15;

    @Spec
    private CommandSpec spec;

    @Option(names = "--kafka", paramLabel = "HOST:PORT", description = "Kafka. Default: ${DEFAULT-VALUE}.")
    private String kafka = "127.0.0.1:9092";

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for every Kafka client, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = {"--api", "--control-plane"},
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description =
                    "REST API of the control plane, which also knows the tokens and roles of users. Default: ${DEFAULT-VALUE}.")
    private URI controlPlane = URI.create("http://127.0.0.1:8085");

    @Option(
            names = "--host",
            paramLabel = "ADDRESS",
            description =
                    "Address to listen on; another than this machine's needs --listen-insecure. Default: ${DEFAULT-VALUE}.")
    private String host = "127.0.0.1";

    @Option(
            names = "--port",
            paramLabel = "PORT",
            description = "Port to listen on, 0 for a free one. Default: ${DEFAULT-VALUE}.")
    private int port = 8080;

    @Option(
            names = {"--listen-insecure", "--insecure"},
            description =
                    "Listen on --host in plain HTTP: a proxy in front terminates TLS, and the control plane requires "
                            + "tokens.")
    private boolean insecure;

    @Option(
            names = "--readable-topics",
            paramLabel = "TOPIC,…",
            split = ",",
            hideParamSyntax = true,
            description =
                    "Topics that may be read, with * for any characters. Topics of dead letters are not among them. Default: data.*,service.*.")
    private List<String> readable;

    @Option(
            names = "--writable-topics",
            paramLabel = "TOPIC,…",
            split = ",",
            hideParamSyntax = true,
            description = "Topics that operators may write. Default: those of the requests to the managers.")
    private List<String> writable;

    @Option(
            names = "--images",
            paramLabel = "DIR,…",
            split = ",",
            hideParamSyntax = true,
            description =
                    "Folders in which the job ingest stores images; pictures of cameras are served from there only. "
                            + "Default: none.")
    private List<Path> images;

    @Mixin
    private TileFlags tiles;

    @Option(
            names = "--web",
            paramLabel = "DIR",
            description =
                    "Serve the files of the page from this folder, for development: a reload shows a change. Default: "
                            + "those of this build.")
    private Path web;

    @Option(names = "--log", paramLabel = "FILE", description = "Where to log. Default: ${DEFAULT-VALUE}.")
    private Path log = Path.of("/dev/stderr");

    @Mixin
    private TrustedProxyFlags trusted;

    @Mixin
    private AccessFlags access;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws InterruptedException {
        DashboardSettings settings = settings();
        new PortCheck().add(host, port, "the dashboard", "--port").requireFree();
        LogFile.writeTo(log);
        CountDownLatch stop = new CountDownLatch(1);
        CountDownLatch stopped = new CountDownLatch(1);
        Runtime.getRuntime().addShutdownHook(new Thread(() -> stopFromOutside(stop, stopped), "stop"));
        try (Dashboard dashboard = Dashboard.start(settings)) {
            PrintWriter out = spec.commandLine().getOut();
            out.println("Dashboard: " + dashboard.uri() + "; Ctrl-C stops it.");
            out.flush();
            ServerCheck.awaitKafka(settings.client(), spec.commandLine().getErr(), stop);
            new ClockWatch().await(stop);
            return 0;
        } catch (IOException e) { // says what is taken, and what to do
            throw new CommandException(e.getMessage(), e);
        } finally {
            stopped.countDown();
        }
    }

    private DashboardSettings settings() {
        if (!insecure && !isLoopback()) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--host %s lets other machines in: tokens would pass in the clear. End TLS in a proxy before it and say --listen-insecure, or keep to 127.0.0.1."
                            .formatted(host));
        }
        try {
            TopicRules rules = new TopicRules(
                    readable == null ? TopicRules.DEFAULT.readable() : readable,
                    writable == null ? TopicRules.DEFAULT.writable() : writable);
            return DashboardSettings.of(port, KafkaClient.settings(kafka, kafkaProperties), controlPlane)
                    .withHost(host)
                    .withRules(rules)
                    .withAllowed(access.allowed())
                    .withProxy(trusted.proxy(spec))
                    .withPage(trusted.pages(tiles.page(web, images == null ? List.of() : images)));
        } catch (IllegalArgumentException e) {
            throw new ParameterException(spec.commandLine(), e.getMessage() + ".", e);
        }
    }

    private boolean isLoopback() {
        try {
            return InetAddress.getByName(host).isLoopbackAddress();
        } catch (UnknownHostException e) {
            throw new ParameterException(
                    spec.commandLine(), "--host %s is not an address of this machine.".formatted(host), e);
        }
    }

    private static void stopFromOutside(CountDownLatch stop, CountDownLatch stopped) {
        stop.countDown();
        try {
            stopped.await(STOPPED_WITHIN_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
