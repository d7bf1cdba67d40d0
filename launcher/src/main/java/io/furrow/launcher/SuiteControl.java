package io.furrow.launcher;

import java.io.IOException;
import java.net.URI;
import java.util.List;
import java.util.Properties;

import io.furrow.control.ControlSettings;
import io.furrow.control.device.DeviceCommands;
import io.furrow.control.provisioning.MqttAccounts;
import io.furrow.control.provisioning.ProvisioningSettings;
import io.furrow.control.rest.RestSettings;
import io.furrow.model.device.FarmSecret;
import io.furrow.model.event.FiwareScope;
import io.furrow.simulators.host.DeviceHost;
import io.furrow.simulators.host.HostSettings;
import io.furrow.simulators.mqtt.MqttAccess;

/** The control plane of a suite, and who simulates the devices of its missions. */
final class SuiteControl implements AutoCloseable {
    private final SuiteSettings suite;
    private final RunDirectory directory;
    private final Properties client;
    private final ControlSettings settings;
    private final ControlService service;
    private DeviceHost devices;
    private URI api;

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
        this.settings = ControlSettings.of(streams).withTenant(suite.fiwareService());
        this.service = new ControlService(settings);
    }

    /** @return the state in which they are then: they answer */
    String startManagers() throws IOException {
        return service.startManagers();
    }

    /** Begins to take commands, and to run the devices of missions. */
    URI join(Ends ends) throws IOException {
        SuiteSettings.Farm farm = suite.farm();
        FarmSecret secret =
                FarmSecretFile.readOrMake(farm.secret() == null ? directory.resolve("farm-secret") : farm.secret());
        FiwareScope scope = settings.missions().scope();
        api = service.serve(
                RestSettings.on(suite.ports().control())
                        .withContextBroker(ends.contextBroker())
                        .withSecret(secret)
                        .withTokens(farm.tokens()),
                suite.watch().options(new DeviceCommands(ends.contextBroker(), scope)),
                ends.iotAgent() == null
                        ? null
                        : new ProvisioningSettings(client, scope, secret, ends.iotAgent(), ends.accounts()));
        if (ends.mqtt() != null && farm.simulates()) {
            devices = DeviceHost.start(HostSettings.of(client, ends.mqtt(), ends.contextBroker(), secret));
        }
        return api;
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
