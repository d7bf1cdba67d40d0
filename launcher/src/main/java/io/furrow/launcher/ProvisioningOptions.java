package io.furrow.launcher;

import java.net.URI;
import java.nio.file.Path;

import picocli.CommandLine.Option;

/** Options that say who may command, and where the devices of missions are made known. */
final class ProvisioningOptions {
    @Option(
            names = "--iot-agent",
            paramLabel = "URL",
            description = "Provision devices of missions at this IoT Agent, for instance http://127.0.0.1:4041. Needs "
                    + "--orion; without it none are provisioned at another context broker.")
    URI iotAgent;

    @Option(
            names = "--mqtt-password-file",
            paramLabel = "FILE",
            description = "Mosquitto's password_file, in which devices of missions get accounts. With --mqtt-acl-file.")
    Path passwords;

    @Option(
            names = "--mqtt-acl-file",
            paramLabel = "FILE",
            description = "Mosquitto's acl_file, in which they get the rules what they may publish and hear.")
    Path rules;

    @Option(
            names = "--mqtt-reload",
            paramLabel = "COMMAND",
            description =
                    "Run by sh after a change of both, for instance 'kill -HUP $(cat /run/mosquitto/mosquitto.pid)'.")
    String reload;

    @Option(
            names = "--farm-secret",
            paramLabel = "FILE",
            description =
                    "The secret of which API keys and MQTT passwords are made; made where there is none. Default with "
                            + "--data: farm-secret in that directory.")
    Path secret;

    @Option(
            names = "--api-tokens",
            paramLabel = "FILE",
            description =
                    "Ask for a token at the control plane's REST API: lines '<name> <token>'. Default: whoever reaches "
                            + "127.0.0.1 may command.")
    Path tokens;

    SuiteSettings.AccountFiles accounts() {
        return new SuiteSettings.AccountFiles(passwords, rules, reload);
    }
}
