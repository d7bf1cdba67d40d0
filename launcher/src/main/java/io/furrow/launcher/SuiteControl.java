package io.furrow.launcher;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.time.Duration;
import java.time.Instant;
import java.util.List;
import java.util.Properties;

import io.furrow.control.ControlPlane;
import io.furrow.control.ControlSettings;
import io.furrow.control.FarmWatch;
import io.furrow.control.WatchOptions;
import io.furrow.control.alarm.StopRobots;
import io.furrow.control.alarm.Webhook;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.health.HealthOptions;
import io.furrow.control.mission.MissionOptions;
import io.furrow.control.provisioning.MosquittoFiles;
import io.furrow.control.provisioning.MqttAccounts;
import io.furrow.control.provisioning.Provisioner;
import io.furrow.control.provisioning.ProvisioningSettings;
import io.furrow.control.rest.RestApi;
import io.furrow.control.rest.RestSettings;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.host.DeviceHost;
import io.furrow.simulators.host.HostSettings;
import io.furrow.simulators.mqtt.MqttAccess;

/** The control plane of a suite: its managers, its REST API, who provisions the devices of missions, and who simulates them. */
final class SuiteControl implements AutoCloseable {
    private static final Duration PATIENCE = Duration.ofSeconds(60);
    private static final Duration UNKNOWN_PERIOD = HealthOptions.DEFAULT.period();
    private static final Duration BETWEEN_LOOKS = Duration.ofMillis(50);

    private final SuiteSettings suite;
    private final RunDirectory directory;
    private final Properties client;
    private final ControlSettings settings;
    private final Parts parts = new Parts();
    private ControlPlane managers;
    private RestApi api;

    /**
     * What devices of missions meet.
     *
     * @param iotAgent null where none are provisioned
     * @param mqtt null where none are simulated
     * @param accounts of the MQTT broker
     */
    record Ends(URI contextBroker, URI iotAgent, MqttAccess mqtt, List<MqttAccounts> accounts) {}

    SuiteControl(SuiteSettings suite, KafkaAccess kafka, RunDirectory directory) {
        this.suite = suite;
        this.directory = directory;
        this.client = kafka.clientProperties();
        Properties streams = kafka.clientProperties();
        streams.setProperty("state.dir", directory.resolve("control-plane").toString());
        this.settings = ControlSettings.of(streams).with(new MissionOptions(Duration.ofMinutes(1), scope()));
    }

    private FiwareScope scope() {
        return FiwareScope.of(suite.fiwareService(), "/");
    }

    /** @return the state in which they are then: they answer */
    String startManagers() throws IOException {
        managers = parts.add("managers", ControlPlane.start(settings));
        Instant end = Instant.now().plus(PATIENCE);
        while (!managers.isHealthy()) {
            if (Instant.now().isAfter(end)) {
                throw new SuiteNotStartedException("The control plane is %s after %d s; see furrow.log"
                        .formatted(managers.state(), PATIENCE.toSeconds()));
            }
            Pause.of(BETWEEN_LOOKS);
        }
        return managers.state();
    }

    /** Begins to take commands, and to run the devices of missions. */
    URI join(Ends ends) throws IOException {
        Path file = suite.farm().secret() == null
                ? directory.resolve("farm-secret")
                : suite.farm().secret();
        FarmSecret secret = FarmSecretFile.readOrMake(file);
        parts.add("farm watch", FarmWatch.start(settings, watch(ends.contextBroker())));
        api = parts.add(
                "REST API",
                RestApi.start(
                        settings,
                        RestSettings.on(suite.ports().control())
                                .withContextBroker(ends.contextBroker())
                                .withSecret(secret)
                                .withTokens(suite.farm().tokens()),
                        managers::state));
        if (ends.iotAgent() != null) {
            parts.add(
                    "provisioner",
                    Provisioner.start(
                            new ProvisioningSettings(client, scope(), secret, ends.iotAgent(), ends.accounts())));
        }
        if (ends.mqtt() != null && suite.farm().simulates()) {
            parts.add(
                    "simulated devices",
                    DeviceHost.start(HostSettings.of(client, ends.mqtt(), ends.contextBroker(), secret)));
        }
        return api.uri();
    }

    private WatchOptions watch(URI contextBroker) {
        SuiteSettings.Watch watch = suite.watch();
        WatchOptions options = WatchOptions.DEFAULT.with(new HealthOptions(watch.silentAfter(), UNKNOWN_PERIOD));
        if (watch.webhook() != null) {
            options = options.with(Webhook.Settings.of(watch.webhook()));
        }
        return watch.stops()
                ? options.with(StopRobots.Settings.of(new DeviceCommands(contextBroker, scope())))
                : options;
    }

    /** Where an MQTT broker of one's own finds its accounts; none where no files are named. */
    static List<MqttAccounts> files(SuiteSettings.AccountFiles files) {
        if (files.passwords() == null && files.rules() == null) {
            return List.of();
        }
        if (files.passwords() == null || files.rules() == null) {
            throw new SuiteNotStartedException(
                    "Name both or none of --mqtt-password-file and --mqtt-acl-file: a password without rules lets nothing"
                            + " through, and rules without passwords let nobody in.");
        }
        return List.of(new MosquittoFiles(files.passwords(), files.rules(), files.reload()));
    }

    URI api() {
        return api.uri();
    }

    @Override
    public void close() {
        parts.close();
    }
}
