package io.furrow.bench.command;

import java.io.IOException;
import java.io.Reader;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import picocli.CommandLine.Option;

import io.furrow.bench.evaluation.Target;
import io.furrow.launcher.RestClient;
import io.furrow.launcher.suite.Suite;
import io.furrow.simulators.device.FleetSettings;

/** A suite that runs already, as {@code ./furrow up} or as separate servers. */
final class DeploymentOptions {
    @Option(
            names = "--against",
            paramLabel = "HOST:PORT",
            description =
                    "Kafka of a suite that runs already; devices and topics of the domain evaluation stay there. Default: suites in this process.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Further properties of Kafka clients, such as of TLS and SASL; with --against.")
    private Path properties;

    @Option(
            names = "--orion",
            paramLabel = "URL",
            defaultValue = "http://127.0.0.1:1026",
            description = "Its context broker. Default: ${DEFAULT-VALUE}.")
    private URI orion;

    @Option(
            names = "--iot-agent",
            paramLabel = "URL",
            defaultValue = "http://127.0.0.1:4041",
            description = "Its IoT Agent. Default: ${DEFAULT-VALUE}.")
    private URI iotAgent;

    @Option(
            names = "--iot-agent-resource",
            paramLabel = "PATH",
            defaultValue = FleetSettings.DEFAULT_RESOURCE,
            description = "Its IOTA_DEFAULT_RESOURCE, \"\" where it is empty. Default: ${DEFAULT-VALUE}.")
    private String iotAgentResource;

    @Option(
            names = "--mqtt",
            paramLabel = "URI",
            defaultValue = "tcp://127.0.0.1:1883",
            description = "Its MQTT broker. Default: ${DEFAULT-VALUE}.")
    private URI mqtt;

    @Option(
            names = "--mqtt-user",
            paramLabel = "NAME",
            defaultValue = Suite.MQTT_USER,
            description = "User at the MQTT broker. Default: ${DEFAULT-VALUE}.")
    private String user;

    @Option(
            names = "--mqtt-password-file",
            paramLabel = "FILE",
            description = "File whose first line is the user's password. Default: the password of ./furrow up.")
    private Path passwordFile;

    @Option(
            names = "--fiware-service",
            paramLabel = "NAME",
            defaultValue = "farm",
            description = "Tenant. Default: ${DEFAULT-VALUE}.")
    private String service;

    /** @return null where no suite is named */
    Target target() throws IOException {
        if (kafka == null) {
            return null;
        }
        String password = passwordFile == null
                ? Suite.MQTT_PASSWORD
                : Files.readString(passwordFile).lines().findFirst().orElse("").strip();
        Properties client = new Properties();
        if (properties != null) {
            try (Reader reader = Files.newBufferedReader(properties)) {
                client.load(reader);
            }
        }
        client.setProperty("bootstrap.servers", kafka);
        FleetSettings devices = new FleetSettings(orion, iotAgent, mqtt, user, password, service, "/")
                .withIotAgentResource(iotAgentResource);
        return new Target(devices, client, false);
    }

    /** What its servers say that they are. */
    List<String> setting() {
        return List.of(
                "A suite that ran already, Kafka at %s, with its own guarantees and checkpoints; sender and reader are a process of their own."
                        .formatted(kafka),
                "Context broker at %s: %s.".formatted(orion, about(orion.resolve("/version"))),
                "IoT Agent at %s: %s.".formatted(iotAgent, about(iotAgent.resolve("/iot/about"))));
    }

    private static String about(URI uri) {
        RestClient.Answer answer = new RestClient().get(uri, Map.of());
        String version = answer.body().findPath("version").asText();
        return !answer.isSuccess() || version.isEmpty() ? "it does not say its version" : "version " + version;
    }
}
