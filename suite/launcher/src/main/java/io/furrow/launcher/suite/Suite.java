package io.furrow.launcher.suite;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.ArrayList;
import java.util.Collection;
import java.util.List;
import java.util.Map;
import java.util.UUID;
import java.util.concurrent.Callable;
import java.util.concurrent.CompletionException;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import io.furrow.cli.option.CommandException;
import io.furrow.dashboard.Dashboard;
import io.furrow.dashboard.DashboardSettings;
import io.furrow.embedded.EmbeddedConnect;
import io.furrow.embedded.EmbeddedFlink;
import io.furrow.embedded.EmbeddedKafka;
import io.furrow.embedded.EmbeddedMongo;
import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.embedded.FreePort;
import io.furrow.fiware.FiwareSettings;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.launcher.process.LogFile;
import io.furrow.launcher.process.Progress;
import io.furrow.launcher.replay.ReplayAnalytics;
import io.furrow.model.result.AnalyticsKind;
import io.furrow.model.topic.Topics;
import io.furrow.provisioner.account.InMemoryAccounts;
import io.furrow.simulators.device.FleetSettings;

/**
 * All parts in this JVM: broker, Connect worker with our connectors, Flink with our jobs, the control plane, and, without an
 * external context broker, an MQTT broker and the FIWARE stand-in. Listens on 127.0.0.1 only, unless configured otherwise for
 * notifications and MQTT.
 */
public final class Suite implements AutoCloseable {
    /** The MQTT user of the demonstration, who may publish as any device. */
    public static final String MQTT_USER = "device";
    /** Its password; sufficient for a broker that only this machine reaches. */
    public static final String MQTT_PASSWORD = "furrow";

    private static final String AGENT_USER = "iot-agent";

    /** One for each of our jobs, three for others, and those of replays. */
    private static final int SLOTS = 6 + AnalyticsKind.values().length + EmbeddedAnalytics.SLOTS;

    private final SuiteSettings settings;
    private final RunDirectory directory;
    private final Progress progress;
    private final Closeables parts = new Closeables();
    private final Closeables fiwareParts = new Closeables();
    private final Closeables connectParts = new Closeables();
    private final Closeables flinkParts = new Closeables();
    private KafkaAccess kafka;
    private EmbeddedConnect connect;
    private EmbeddedFlink flink;
    private Jobs jobs;
    private EmbeddedMqtt mqtt;
    private FiwareStandIn fiware;
    private String mongo;
    private URI contextBroker;
    private SuiteControl control;
    private ReplayAnalytics replays;
    private final InMemoryAccounts accounts = new InMemoryAccounts();
    private final String agentPassword = UUID.randomUUID().toString();
    private Connectors connectors;
    private URI listener;
    private URI dashboard;

    private Suite(SuiteSettings settings, RunDirectory directory, Progress progress) {
        this.settings = settings;
        this.directory = directory;
        this.progress = progress;
    }

    /**
     * Starts everything and returns when notifications are accepted and all jobs run.
     *
     * @param directory for all files; outlives the suite
     * @throws CommandException if a part cannot start; everything is stopped then
     */
    public static Suite start(SuiteSettings settings, RunDirectory directory, Progress progress) throws Exception {
        Suite suite = directory.closingFirst(new Suite(settings, directory, progress));
        boolean started = false;
        try {
            suite.start();
            started = true;
            return suite;
        } catch (CompletionException e) {
            throw e.getCause() instanceof CommandException refused ? refused : e;
        } finally {
            if (!started) {
                suite.close();
            }
        }
    }

    private void start() throws Exception {
        SuiteFields.requireUsable(settings).forEach(progress::note);
        FarmSecretFile.requireLasting(directory, settings);
        PortCheck.free(settings);
        ServerCheck.answering(settings);
        LogFile.writeTo(directory.resolve("furrow.log"));
        // Before any data is stored, so that a directory with data has its secret.
        Path secret = FarmSecretFile.of(directory, settings.farm().secret().file());
        startKafka();
        // Stopped in reverse order: devices, jobs, connectors, and then the servers that these write to.
        parts.add("MQTT and FIWARE", fiwareParts);
        parts.add("Connect", connectParts);
        parts.add("Flink and MongoDB", flinkParts);
        startMongo(); // the control plane reads the stored missions there
        control = parts.add("control plane", new SuiteControl(settings, kafka, directory, secret, mongo));
        ParallelStart.run(
                this::startFiwareAndConnect,
                this::startFlink,
                () -> progress.step("control plane", control::startManagers));
        startConnectors();
        progress.step("devices of missions", this::joinControl);
        startDashboard();
        replays = ReplayAnalytics.start(
                kafka.clientProperties(),
                new EmbeddedAnalytics(flink, jobs, new SuiteJobs(settings, kafka, mongo, directory)));
    }

    private <T extends AutoCloseable> T start(Closeables among, String name, Callable<T> part) throws Exception {
        return among.add(name, progress.step(name, part));
    }

    private URI joinControl() {
        try {
            return control.join(endpoints(), connect.uri());
        } catch (IOException e) { // says what is unavailable or refused, and what to do
            throw new CommandException(e.getMessage(), e);
        }
    }

    private void startDashboard() throws Exception {
        DashboardSettings page = DashboardSettings.of(
                        settings.ports().dashboard(), kafka.clientProperties(), control.api())
                .withAllowed(settings.allowed())
                .withPage(settings.page().withImages(List.of(directory.resolve(SuiteJobs.IMAGES))));
        dashboard = start(parts, "dashboard", () -> Dashboard.start(page)).uri();
    }

    private void startKafka() throws Exception {
        String servers = settings.kafka();
        if (servers == null) {
            Path log = directory.resolve("kafka");
            servers = start(
                            parts,
                            "Kafka",
                            () -> EmbeddedKafka.start(log, settings.ports().kafka()))
                    .bootstrapServers();
        }
        kafka = parts.add("Kafka client", KafkaAccess.to(servers, settings.kafkaProperties()));
        kafka.ensureTopics();
    }

    private void startConnect() throws Exception {
        connect = start(
                connectParts,
                "Kafka Connect",
                () -> EmbeddedConnect.start(
                        kafka.bootstrapServers(),
                        Path.of(System.getProperty("furrow.plugins")),
                        settings.ports().connect(),
                        kafka.connectSettings(),
                        settings.allowed()));
    }

    private void startMongo() throws Exception {
        mongo = settings.mongo();
        if (mongo == null) {
            Path documents = directory.resolve("mongo");
            mongo = start(
                            flinkParts,
                            "the server for missions",
                            () -> EmbeddedMongo.start(
                                    documents, settings.ports().mongo()))
                    .uri();
        }
    }

    private void startFlink() throws Exception {
        flink = start(
                flinkParts,
                "Flink",
                () -> EmbeddedFlink.start(SLOTS, settings.ports().flink(), settings.allowed()));
        SuiteFields fields = new SuiteFields(new FieldsTopic(kafka.clientProperties()));
        progress.step("fields", () -> {
            fields.write(settings, directory);
            return fields.zones(directory);
        });
        jobs = new Jobs(flink, directory.resolve("jobs"));
        progress.step("jobs", () -> {
            new SuiteJobs(settings, kafka, mongo, directory).all().forEach(jobs::submit);
            jobs.awaitStarted();
            return jobs.running();
        });
    }

    /** In this order, because stored connectors run as soon as their worker does. */
    private void startFiwareAndConnect() throws Exception {
        startFiware();
        startConnect();
    }

    private void startFiware() throws Exception {
        if (settings.orion() != null) {
            contextBroker = settings.orion();
            return;
        }
        mqtt = fiwareParts.add(
                "MQTT",
                EmbeddedMqtt.start(
                        settings.fiware().listening().mqttHost(),
                        settings.ports().mqtt(),
                        passwords(),
                        new EmbeddedMqtt.Users(
                                accounts::authenticates, accounts::exists, accounts::mayWrite, accounts::mayRead)));
        fiware = start(fiwareParts, "MQTT and the FIWARE stand-in", this::startStandIn);
        contextBroker = fiware.contextBroker();
    }

    /** Passwords of users with all permissions. */
    private Map<String, String> passwords() {
        return settings.sharedLogin()
                ? Map.of(AGENT_USER, agentPassword, MQTT_USER, MQTT_PASSWORD)
                : Map.of(AGENT_USER, agentPassword);
    }

    private SuiteControl.Endpoints endpoints() {
        return fiware == null
                ? SuiteControl.Endpoints.of(contextBroker, settings.farm())
                : SuiteControl.Endpoints.of(fiware, mqtt, accounts);
    }

    private FiwareStandIn startStandIn() {
        try {
            return FiwareStandIn.start(standIn());
        } catch (IllegalStateException e) { // says what is wrong with its state or its broker, and what to do
            throw new CommandException(e.getMessage(), e);
        }
    }

    private FiwareSettings standIn() {
        FiwareSettings here = new FiwareSettings(
                        settings.ports().orion(), settings.ports().iotAgent(), mqtt.uri(), AGENT_USER, agentPassword)
                .withAllowed(settings.allowed());
        return directory.isTemporary() ? here : here.withState(directory.resolve("fiware.json.gz"));
    }

    private void startConnectors() throws Exception {
        int port = FreePort.orFree(settings.ports().listener());
        SuiteSettings.Listening listening = settings.fiware().listening();
        listener = URI.create("http://" + SuiteSettings.Listening.here(listening.host()) + ":" + port + "/v2/notify");
        connectors = new Connectors(connect.uri(), listener.resolve("/health"), settings.fiware());
        progress.step("NGSI source and sink", () -> {
            connectors.source(
                    new Connectors.Source(
                            port, directory.resolve("journal"), settings.allowed(), kafka.clientProperties()),
                    contextBroker);
            List<String> results = new ArrayList<>(AnalyticsKind.topics());
            results.add(Topics.CONTEXT);
            connectors.sink(contextBroker, results);
            return listener;
        });
    }

    public KafkaAccess kafka() {
        return kafka;
    }

    public URI contextBroker() {
        return contextBroker;
    }

    /** The MongoDB of missions. */
    public String mongo() {
        return mongo;
    }

    public URI connect() {
        return connect.uri();
    }

    public URI flink() {
        return flink.webUi();
    }

    /** Address of the page. */
    public URI dashboard() {
        return dashboard;
    }

    /** Address of the listener for notifications. */
    public URI listener() {
        return listener;
    }

    public SuiteSettings settings() {
        return settings;
    }

    /** The files of this suite. */
    public Path directory() {
        return directory.path();
    }

    /** Job ids by name. */
    public Map<String, String> jobs() {
        return jobs.running().entrySet().stream()
                .collect(Collectors.toMap(
                        Map.Entry::getKey, job -> job.getValue().toHexString()));
    }

    /** A sentence for each replay whose analytics waits for slots, and for a context broker that cannot notify this suite. */
    public Collection<String> notices() {
        return hasStandIn()
                ? replays.waiting()
                : Stream.concat(connectors.undelivered().stream(), replays.waiting().stream())
                        .toList();
    }

    /** Access of devices to MQTT and the stand-in; only without an external context broker. */
    public FleetSettings devices() {
        return new FleetSettings(
                contextBroker,
                fiware.iotAgent(),
                mqtt.uri(),
                MQTT_USER,
                MQTT_PASSWORD,
                fiwareService(),
                settings.fiware().scope().servicePath());
    }

    /** Base of the control plane's REST API. */
    public URI control() {
        return control.api();
    }

    /** Base of the pages {@code /health}, {@code /ready} and {@code /metrics}. */
    public URI health() {
        return control.health();
    }

    public String fiwareService() {
        return settings.fiware().scope().service();
    }

    /** Whether the MQTT broker and the stand-in are embedded. */
    public boolean hasStandIn() {
        return fiware != null;
    }

    /** Stops everything in reverse order; jobs of a persistent suite with a savepoint. Idempotent. */
    @Override
    public void close() {
        if (replays != null) {
            replays.close();
        }
        replays = null;
        if (jobs != null && !directory.isTemporary()) {
            jobs.stop();
        }
        jobs = null;
        parts.close();
    }
}
