package io.furrow.launcher.option;

import java.io.IOException;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.launcher.suite.Suite;
import io.furrow.simulators.device.FleetSettings;

/** The servers to which devices report, by default those of {@code ./furrow demo} on this machine. */
public final class FiwareOptions {
    @Option(
            names = "--orion",
            paramLabel = "URL",
            description = "Context broker, to which robots report. Default: ${DEFAULT-VALUE}.")
    private URI orion = URI.create("http://127.0.0.1:1026");

    @Option(
            names = "--iot-agent",
            paramLabel = "URL",
            description = "IoT Agent, which receives all other devices. Default: ${DEFAULT-VALUE}.")
    private URI iotAgent = URI.create("http://127.0.0.1:4041");

    @Option(
            names = "--iot-agent-resource",
            paramLabel = "PATH",
            defaultValue = FleetSettings.DEFAULT_RESOURCE,
            description =
                    "Default resource of the IoT Agent (IOTA_DEFAULT_RESOURCE), \"\" where it is empty. Default: ${DEFAULT-VALUE}.")
    private String iotAgentResource;

    @Option(
            names = "--mqtt",
            paramLabel = "URI",
            description = "MQTT broker: tcp://host:port, or ssl://host:port with TLS. Default: ${DEFAULT-VALUE}.")
    private URI mqtt = URI.create("tcp://127.0.0.1:1883");

    @Option(
            names = "--mqtt-user",
            paramLabel = "NAME",
            defaultValue = Suite.MQTT_USER,
            description =
                    "User at the MQTT broker who may publish for all devices; the broker of ./furrow up has no such "
                            + "user. Default: ${DEFAULT-VALUE}.")
    private String user;

    @Option(
            names = "--mqtt-password-file",
            paramLabel = "FILE",
            description = "File whose first line is the user's password. Default: the password of ./furrow demo.")
    private Path passwordFile;

    @Option(names = "--fiware-service", paramLabel = "NAME", description = "Tenant. Default: ${DEFAULT-VALUE}.")
    private String service = "farm";

    @Mixin
    private FiwareAccessOptions access;

    /** @throws IOException if the file of the password cannot be read */
    public FleetSettings settings() throws IOException {
        String password = passwordFile == null
                ? Suite.MQTT_PASSWORD
                : Files.readString(passwordFile).lines().findFirst().orElse("").strip();
        String path = access.scope(service).servicePath();
        return new FleetSettings(orion, iotAgent, mqtt, user, password, service, path)
                .withIotAgentResource(iotAgentResource)
                .withToken(access.token());
    }
}
