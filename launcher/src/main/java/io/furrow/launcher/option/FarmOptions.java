package io.furrow.launcher.option;

import java.net.URI;
import java.nio.file.Path;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.launcher.suite.SuiteSettings;
import io.furrow.model.file.AccessToken;

/** Options of {@code up} for a real farm: who may command, and an IoT Agent and an MQTT broker that already run. */
public final class FarmOptions {
    @Mixin
    private ProvisioningOptions provisioning;

    @Option(
            names = "--mqtt",
            paramLabel = "URI",
            description =
                    "MQTT broker of simulated devices: tcp://host:port, or ssl://host:port with TLS. With --orion only; without "
                            + "it no device is simulated then.")
    private URI mqtt;

    @Option(
            names = "--mqtt-trusted",
            paramLabel = "FILE",
            description =
                    "PEM file with the certificates to trust at the MQTT broker. Default: those that Java trusts.")
    private Path mqttTrusted;

    @Option(
            names = "--no-simulated-devices",
            description = "Simulate none of the devices that missions ask for: something else hosts them.")
    private boolean hostedElsewhere;

    public SuiteSettings.Farm farm(String fiwareService, AccessToken token) {
        return new SuiteSettings.Farm(
                provisioning.agent(fiwareService, token),
                mqtt,
                mqttTrusted,
                provisioning.accounts(),
                provisioning.secret(),
                provisioning.tokens,
                !hostedElsewhere);
    }
}
