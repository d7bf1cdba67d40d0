package io.furrow.launcher.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.net.URI;
import java.nio.file.Path;
import java.util.Properties;
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
import io.furrow.control.ControlSettings;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.mission.MissionSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.control.rest.access.CertificateFiles;
import io.furrow.kafka.secret.SecretFile;
import io.furrow.launcher.option.AccessFlags;
import io.furrow.launcher.option.FiwareAccessOptions;
import io.furrow.launcher.option.ProvisioningOptions;
import io.furrow.launcher.option.ReplayFlags;
import io.furrow.launcher.option.RestTlsOptions;
import io.furrow.launcher.option.WatchFlags;
import io.furrow.launcher.process.ClockWatch;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.suite.ControlService;
import io.furrow.launcher.suite.FarmSecretFile;
import io.furrow.launcher.suite.PortCheck;
import io.furrow.launcher.suite.ServerCheck;
import io.furrow.model.event.FiwareScope;
import io.furrow.model.file.AccessToken;
import io.furrow.provisioner.AgentSettings;
import io.furrow.provisioner.ProvisioningSettings;

/** {@code ./furrow control-plane}. */
@Command(
        name = "control-plane",
        abbreviateSynopsis = true,
        description = "Runs an instance of the control plane with an existing Kafka. Several instances share the work; "
                + "when one fails, another takes over.")
public final class ControlPlaneCommand implements Callable<Integer> {
    private static final long STOPPED_WITHIN_SECONDS = 35;
    /** Without Kafka nothing can be handed over; another instance takes over as after a crash. */
    private static final long ENDED_AFTER_SECONDS = 3;

    @Spec
    private CommandSpec spec;

    @Option(names = "--kafka", paramLabel = "HOST:PORT", required = true, description = "Kafka of the farm.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for every Kafka client, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--standby-replicas",
            paramLabel = "N",
            description = "Number of standby replicas of all state on other instances. Default: 0.")
    private int standbyReplicas = 0;

    @Option(
            names = "--control-host",
            paramLabel = "ADDRESS",
            description =
                    "Address of the REST API; another than this machine's needs --api-tokens, and --api-certificate or "
                            + "--api-insecure. Default: ${DEFAULT-VALUE}.")
    private String host = "127.0.0.1";

    @Option(
            names = "--control-port",
            paramLabel = "PORT",
            description = "Port of the REST API, 0 for a free one. Default: ${DEFAULT-VALUE}.")
    private int port = 8085;

    @Option(
            names = "--health-port",
            paramLabel = "PORT",
            description =
                    "Port of /health, /ready and /metrics, plain HTTP without tokens even if the API has both; 0 for a "
                            + "free one. Default: ${DEFAULT-VALUE}.")
    private int healthPort = 8086;

    @Option(
            names = "--orion",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description = "Context broker, through which commands reach devices. Default: ${DEFAULT-VALUE}.")
    private URI orion = URI.create("http://127.0.0.1:1026");

    @Option(
            names = "--connect-url",
            paramLabel = "URL",
            converter = HttpUriConverter.class,
            description =
                    "REST API of Kafka Connect, for instance http://127.0.0.1:8083: /ready shows its connectors, and a "
                            + "failed one raises an alarm. Default: not used.")
    private URI connect;

    @Option(
            names = "--replication-factor",
            paramLabel = "N",
            description =
                    "Replication factor of created topics, including internal ones; existing topics do not change. "
                            + "Default: that of the brokers.")
    private short replicationFactor = -1;

    @Option(
            names = "--fiware-service",
            paramLabel = "NAME",
            description = "Tenant of the context broker. Default: ${DEFAULT-VALUE}.")
    private String fiwareService = "farm";

    @Option(names = "--log", paramLabel = "FILE", description = "Where to log. Default: ${DEFAULT-VALUE}.")
    private Path log = Path.of("/dev/stderr");

    @Mixin
    private FiwareAccessOptions fiware;

    @Mixin
    private ProvisioningOptions provisioning;

    @Mixin
    private AccessFlags access;

    @Mixin
    private RestTlsOptions tls;

    @Mixin
    private WatchFlags watch;

    @Mixin
    private ReplayFlags replays;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() throws InterruptedException {
        if (provisioning.iotAgent != null && provisioning.secret == null) {
            throw new ParameterException(
                    spec.commandLine(),
                    "--iot-agent needs --farm-secret: all instances and the host of the devices make passwords of the same.");
        }
        watch.watch(null); // refuses what cannot be used before anything starts
        AccessToken token = fiware.token();
        provisioning.agent(fiwareService, token); // the same
        provisioning.mqttPublic(); // the same
        if (replicationFactor < 1 && replicationFactor != -1) {
            throw new ParameterException(
                    spec.commandLine(), "--replication-factor is at least 1, or -1 for that of the brokers.");
        }
        replays.settings(); // the same
        new PortCheck()
                .add(host, port, "the REST API", "--control-port")
                .add(host, healthPort, "its health", "--health-port")
                .requireFree();
        CertificateFiles certificate = tls.certificate();
        SecretFile secret = provisioning.secret == null
                ? null
                : FarmSecretFile.open(provisioning.secret, settings().client(), provisioning.replacedSecret);
        RestSettings rest = RestSettings.on(port)
                .withHost(host)
                .withTokens(provisioning.tokens)
                .withCertificate(certificate)
                .withInsecure(tls.insecure)
                .withContextBroker(orion)
                .withToken(token)
                .withSecret(secret)
                .withMqtt(provisioning.mqttPublic())
                .withAllowed(access.allowed());
        try {
            rest.check();
        } catch (IOException e) { // says what to do
            throw new CommandException(e.getMessage(), e);
        }
        ServerCheck.awaitKafka(settings().client(), spec.commandLine().getErr(), new CountDownLatch(1));
        LogFile.writeTo(log);
        return runUntilStopped(rest, secret);
    }

    private int runUntilStopped(RestSettings rest, SecretFile secret) throws InterruptedException {
        CountDownLatch stop = new CountDownLatch(1);
        CountDownLatch stopped = new CountDownLatch(1);
        ControlService service = new ControlService(settings());
        Runtime.getRuntime().addShutdownHook(new Thread(() -> stopFromOutside(service, stop, stopped), "stop"));
        try (service) {
            PrintWriter out = spec.commandLine().getOut();
            out.println("The control plane starts; Ctrl-C stops it.");
            out.flush();
            RestApi.check(settings(), rest);
            service.startManagers();
            if (connect != null) {
                service.watchConnectors(connect);
            }
            out.println("REST API: " + serve(service, rest, secret) + "/openapi.json");
            out.println("Health: " + service.health() + "/ready");
            out.flush();
            new ClockWatch().await(stop);
            return 0;
        } catch (IOException e) { // says what is unavailable or refused, and what to do
            throw new CommandException(e.getMessage(), e);
        } finally {
            stopped.countDown();
        }
    }

    private ControlSettings settings() {
        Properties client = KafkaClient.settings(kafka, kafkaProperties);
        return ControlSettings.of(client)
                .with(new MissionSettings(provisioning.startTimeout, fiware.scope(fiwareService), false))
                .withStandbyReplicas(standbyReplicas)
                .withReplicationFactor(replicationFactor)
                .with(replays.settings());
    }

    private URI serve(ControlService service, RestSettings rest, SecretFile secret) throws IOException {
        ControlSettings settings = settings();
        FiwareScope scope = settings.missions().scope();
        AgentSettings agent = provisioning.agent(fiwareService, rest.token());
        return service.serve(
                rest,
                healthPort,
                watch.watch(null).options(new DeviceCommands(orion, scope, rest.token())),
                agent == null
                        ? null
                        : new ProvisioningSettings(
                                settings.client(),
                                scope,
                                secret,
                                agent,
                                provisioning.accounts().accounts(),
                                provisioning.gateways,
                                provisioning.accounts().connections(),
                                provisioning.forgets));
    }

    private static void stopFromOutside(ControlService service, CountDownLatch stop, CountDownLatch stopped) {
        stop.countDown();
        try {
            stopped.await(service.reachesKafka() ? STOPPED_WITHIN_SECONDS : ENDED_AFTER_SECONDS, TimeUnit.SECONDS);
        } catch (InterruptedException e) {
            Thread.currentThread().interrupt();
        }
    }
}
