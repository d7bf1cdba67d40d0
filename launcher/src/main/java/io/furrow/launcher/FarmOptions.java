package io.furrow.launcher;

import java.net.URI;
import java.nio.file.Path;

import picocli.CommandLine.Option;

/** Options of {@code up} for a real farm: who may command, and an IoT Agent and an MQTT broker that already run. */
final class FarmOptions {
    @Option(
            names = "--iot-agent",
            paramLabel = "URL",
            description =
                    "Provision devices of missions at this IoT Agent, for instance http://127.0.0.1:4041. With --orion only; "
                            + "without it none are provisioned then.")
    private URI iotAgent;

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
            names = "--mqtt-password-file",
            paramLabel = "FILE",
            description = "Mosquitto's password_file, in which devices of missions get accounts. With --mqtt-acl-file.")
    private Path passwords;

    @Option(
            names = "--mqtt-acl-file",
            paramLabel = "FILE",
            description = "Mosquitto's acl_file, in which they get the rules what they may publish and hear.")
    private Path rules;

    @Option(
            names = "--mqtt-reload",
            paramLabel = "COMMAND",
            description =
                    "Run by sh after a change of both, for instance 'kill -HUP $(cat /run/mosquitto/mosquitto.pid)'.")
    private String reload;

    @Option(
            names = "--farm-secret",
            paramLabel = "FILE",
            description =
                    "The secret of which API keys and MQTT passwords are made; made where there is none. Default: farm-secret "
                            + "in the directory of --data.")
    private Path secret;

    @Option(
            names = "--no-simulated-devices",
            description = "Simulate none of the devices that missions ask for: something else hosts them.")
    private boolean hostedElsewhere;

    @Option(
            names = "--api-tokens",
            paramLabel = "FILE",
            description =
                    "Ask for a token at the control plane's REST API: lines '<name> <token>'. Default: whoever reaches "
                            + "127.0.0.1 may command.")
    private Path tokens;

    SuiteSettings.Farm farm() {
        return new SuiteSettings.Farm(
                iotAgent,
                mqtt,
                mqttTrusted,
                new SuiteSettings.AccountFiles(passwords, rules, reload),
                secret,
                tokens,
                !hostedElsewhere);
    }
}
