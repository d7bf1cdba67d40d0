package io.furrow.launcher.suite;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Path;
import java.util.List;
import java.util.Properties;

import io.furrow.control.ControlSettings;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.mission.MissionSettings;
import io.furrow.control.replay.ReplaySettings;
import io.furrow.control.rest.RestSettings;
import io.furrow.embedded.EmbeddedMqtt;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.kafka.ComponentStatus;
import io.furrow.kafka.secret.SecretFile;
import io.furrow.model.event.FiwareScope;
import io.furrow.provisioner.AgentSettings;
import io.furrow.provisioner.ConnectionSources;
import io.furrow.provisioner.ProvisioningSettings;
import io.furrow.provisioner.account.InMemoryAccounts;
import io.furrow.provisioner.account.MqttAccounts;
import io.furrow.simulators.host.DeviceHost;
import io.furrow.simulators.host.HostSettings;
import io.furrow.simulators.mqtt.MqttAccess;

/** The control plane of a suite with the simulator of its missions' devices. */
final class SuiteControl implements AutoCloseable {
    private final SuiteSettings suite;
    private final Path secret;
    private final Properties client;
    private final ControlSettings settings;
    private final ControlService service;
    private DeviceHost devices;
    private URI api;

    /**
     * The servers that devices of missions use.
     *
     * @param iotAgent null if none are provisioned
     * @param mqtt null if none are simulated
     * @param accounts of the MQTT broker
     */
    record Endpoints(
            URI contextBroker,
            AgentSettings iotAgent,
            MqttAccess mqtt,
            List<MqttAccounts> accounts,
            ConnectionSources connections) {
        /** Those of this suite. */
        static Endpoints of(FiwareStandIn fiware, EmbeddedMqtt mqtt, InMemoryAccounts accounts) {
            return new Endpoints(
                    fiware.contextBroker(),
                    AgentSettings.at(fiware.iotAgent()),
                    new MqttAccess(mqtt.uri(), null, 1),
                    List.of(accounts),
                    new ConnectionSources(List.of(accounts), new StandInMeasures(fiware.history())));
        }

        /** External ones. */
        static Endpoints of(URI contextBroker, SuiteSettings.Farm farm) {
            return new Endpoints(
                    contextBroker,
                    farm.iotAgent(),
                    farm.mqtt() == null ? null : new MqttAccess(farm.mqtt(), farm.mqttTrusted(), 1),
                    farm.accounts().accounts(),
                    farm.accounts().connections());
        }
    }

    /**
     * @param secret file of the farm's secret
     * @param mongo connection string of the MongoDB of missions
     */
    SuiteControl(SuiteSettings suite, KafkaAccess kafka, RunDirectory directory, Path secret, String mongo) {
        this.suite = suite;
        this.secret = secret;
        this.client = kafka.clientProperties();
        Properties streams = kafka.clientProperties();
        streams.setProperty("state.dir", directory.resolve("control-plane").toString());
        SuiteSettings.Missions missions = suite.farm().missions();
        this.settings = ControlSettings.of(streams)
                .with(new MissionSettings(
                        missions.startTimeout(), suite.fiware().scope(), missions.simulatedByDefault()))
                .with(ReplaySettings.DEFAULT.withMongo(mongo));
        this.service = new ControlService(settings);
    }

    /** @return their state once they answer */
    String startManagers() throws IOException {
        return service.startManagers();
    }

    /**
     * Begins to accept commands, and to run the devices of missions.
     *
     * @param connect base of Kafka Connect's REST API
     */
    URI join(Endpoints ends, URI connect) throws IOException {
        service.watchConnectors(connect);
        SuiteSettings.Farm farm = suite.farm();
        SecretFile source = FarmSecretFile.open(secret, client, farm.secret().replaced());
        boolean simulates = ends.mqtt() != null && farm.missions().simulates();
        FiwareScope scope = settings.missions().scope();
        api = service.serve(
                RestSettings.on(suite.ports().control())
                        .withContextBroker(ends.contextBroker())
                        .withToken(suite.fiware().token())
                        .withSecret(source)
                        .withMqtt(
                                farm.mqttPublic() != null || ends.mqtt() == null
                                        ? farm.mqttPublic()
                                        : ends.mqtt().broker())
                        .withTokens(farm.tokens())
                        .withAllowed(suite.allowed()),
                suite.ports().health(),
                suite.watch()
                        .options(new DeviceCommands(
                                ends.contextBroker(), scope, suite.fiware().token())),
                ends.iotAgent() == null
                        ? null
                        : new ProvisioningSettings(
                                client,
                                scope,
                                source,
                                ends.iotAgent(),
                                ends.accounts(),
                                simulates || farm.accounts().gateways(),
                                ends.connections(),
                                farm.accounts().forgets()));
        if (simulates) {
            devices = DeviceHost.start(HostSettings.of(client, ends.mqtt(), ends.contextBroker(), source)
                    .withToken(suite.fiware().token()));
            service.require(this::deviceHost);
        }
        return api;
    }

    private ComponentStatus deviceHost() {
        ComponentStatus.State state = devices.isAlive() ? ComponentStatus.State.UP : ComponentStatus.State.DEAD;
        return new ComponentStatus("deviceHost", state, devices.lastPoll(), devices.lastFailure());
    }

    /** Base of the pages for probes. */
    URI health() {
        return service.health();
    }

    URI api() {
        return api;
    }

    @Override
    public void close() {
        if (devices != null) {
            devices.close();
        }
        service.close();
    }
}
