package io.furrow.launcher.suite;

import java.io.IOException;
import java.net.URI;
import java.time.Clock;
import java.time.Duration;
import java.time.Instant;
import java.util.function.Supplier;

import org.slf4j.Logger;
import org.slf4j.LoggerFactory;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.FarmWatch;
import io.furrow.control.WatchOptions;
import io.furrow.control.readiness.ConnectorWatch;
import io.furrow.control.readiness.HealthServer;
import io.furrow.control.replay.RecordingWatch;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.replay.TopicCleanup;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.fields.FieldFiles;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.Probe;
import io.furrow.kafka.Readiness;
import io.furrow.launcher.process.Sleep;
import io.furrow.provisioner.Provisioner;
import io.furrow.provisioner.ProvisioningSettings;

/** The control plane in this JVM: managers, REST API, alarms, and the provisioner of the devices of missions. */
public final class ControlService implements AutoCloseable {
    private static final Logger LOG = LoggerFactory.getLogger(ControlService.class);
    private static final Duration START_TIMEOUT = Duration.ofSeconds(60);
    private static final Duration POLL_INTERVAL = Duration.ofMillis(50);

    private final ControlSettings settings;
    private final Closeables parts = new Closeables();
    private final Readiness readiness = new Readiness(Clock.systemUTC());
    private volatile Probe kafka;
    private ControlPlane managers;
    private URI health;

    public ControlService(ControlSettings settings) {
        this.settings = settings;
    }

    /**
     * Starts the managers and waits until they answer, at most a minute: after a crash of the brokers a rebalance can take longer, and
     * ending the process would prolong it. Use {@code /ready} to find out.
     *
     * @return their state then
     */
    public String startManagers() throws IOException {
        kafka = parts.add("Kafka probe", Probe.kafka(settings.client()));
        readiness.require(kafka::status);
        managers = parts.add("managers", ControlPlane.start(settings));
        readiness.require(managers::status);
        Instant end = Instant.now().plus(START_TIMEOUT);
        while (!managers.isHealthy() && Instant.now().isBefore(end)) {
            Sleep.of(POLL_INTERVAL);
        }
        if (!managers.isHealthy()) {
            LOG.warn("the managers are {} after {} s; still waiting", managers.state(), START_TIMEOUT.toSeconds());
        }
        return managers.state();
    }

    /**
     * Begins to accept and execute commands.
     *
     * @param healthPort of the pages for probes, 0 for a free one
     * @param provisioning null if no devices are provisioned
     * @return base of the REST API
     */
    public URI serve(RestSettings rest, int healthPort, WatchOptions watch, ProvisioningSettings provisioning)
            throws IOException {
        FarmWatch farmWatch = parts.add("farm watch", FarmWatch.start(settings, watch));
        readiness.require(farmWatch::status);
        readiness.requireAll(farmWatch::workers);
        startReplays(settings.replays());
        RestApi api = parts.add("REST API", RestApi.start(settings, rest, readiness, FieldFiles::read));
        show("contextBroker", rest.contextBroker(), "/version");
        if (provisioning != null) {
            Provisioner provisioner = parts.add("provisioner", Provisioner.start(provisioning));
            readiness.require(provisioner::status);
            show("iotAgent", provisioning.agent().base(), "/iot/about");
        }
        HealthServer pages = parts.add(
                "health pages",
                HealthServer.start(
                        rest.host(), healthPort, rest.allowed(), new HealthServer.Pages(readiness, api::metrics)));
        health = pages.uri();
        return api.uri();
    }

    /** Monitors the connectors of a Kafka Connect and raises alarms for failed ones. @param connect base of its REST API */
    public void watchConnectors(URI connect) {
        ConnectorWatch watch = parts.add("connector watch", ConnectorWatch.start(connect, settings.client()));
        readiness.showAll(watch::statuses);
    }

    private void startReplays(ReplaySettings replays) throws IOException {
        if (replays.hasRecordings()) {
            RecordingWatch recordings =
                    parts.add("recording watch", RecordingWatch.start(settings.client(), replays, Clock.systemUTC()));
            readiness.require(recordings::status);
        }
        TopicCleanup cleanup =
                parts.add("topic cleanup", TopicCleanup.start(settings.client(), replays, Clock.systemUTC()));
        readiness.require(cleanup::status);
    }

    /** Adds a part of this process that is started elsewhere. */
    void require(Supplier<ComponentStatus> status) {
        readiness.require(status);
    }

    /** @param base null if there is none */
    private void show(String name, URI base, String path) {
        if (base != null) {
            Probe probe = parts.add(
                    name + " probe", Probe.http(name, URI.create(base.toString().replaceAll("/+$", "") + path)));
            readiness.show(probe::status);
        }
    }

    /** Whether Kafka has answered recent requests. */
    public boolean reachesKafka() {
        return kafka == null || kafka.status().state() == ComponentStatus.State.UP;
    }

    /** Base of the pages for probes. */
    public URI health() {
        return health;
    }

    @Override
    public void close() {
        parts.close();
    }
}
