package io.furrow.launcher.option;

import java.net.URI;
import java.nio.file.Path;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.file.AccessToken;

/** Options of {@code up} for a real farm: access to commands, and an existing IoT Agent and MQTT broker. */
public final class FarmOptions {
    @Mixin
    private ProvisioningOptions provisioning;

    @Option(
            names = "--mqtt",
            paramLabel = "URI",
            description =
                    "MQTT broker of simulated devices: tcp://host:port, or ssl://host:port with TLS. With --orion and "
                            + "--simulate-devices.")
    private URI mqtt;

    @Option(
            names = "--mqtt-trusted",
            paramLabel = "FILE",
            description =
                    "PEM file with the certificates to trust at the MQTT broker. Default: those that Java trusts.")
    private Path mqttTrusted;

    @Option(
            names = "--simulate-devices",
            description =
                    "Simulate the devices of missions that have \"simulated\": true, as those of the template thesis-demo.")
    private boolean simulates;

    /** The default, which scripts may state explicitly. */
    @Option(names = "--no-simulated-devices", hidden = true)
    private boolean simulatesNone;

    /** Whether devices are to be simulated without an MQTT broker to publish to. */
    public boolean simulatesNowhere() {
        return simulates && mqtt == null;
    }

    public SuiteSettings.Farm farm(String fiwareService, AccessToken token) {
        return new SuiteSettings.Farm(
                provisioning.agent(fiwareService, token),
                mqtt,
                provisioning.mqttPublic(),
                mqttTrusted,
                provisioning.accounts(),
                provisioning.secret(),
                provisioning.tokens,
                new SuiteSettings.Missions(provisioning.startTimeout, simulates && !simulatesNone, false));
    }
}
