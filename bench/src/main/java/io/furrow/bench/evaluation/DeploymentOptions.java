package io.furrow.bench.evaluation;

import java.io.IOException;
import java.io.Reader;
import java.net.URI;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Map;
import java.util.Properties;

import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.launcher.option.FiwareOptions;
import io.furrow.launcher.process.RestClient;
import io.furrow.simulators.device.FleetSettings;

/** Options for an existing suite, run by {@code ./furrow up} or as separate servers. */
final class DeploymentOptions {
    @Option(
            names = "--against",
            paramLabel = "HOST:PORT",
            description =
                    "Kafka of a running suite; devices and topics of the domain evaluation are not deleted. Default: suites in this process.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Additional properties of the Kafka clients, e.g. for TLS and SASL; with --against.")
    private Path properties;

    @Mixin
    private FiwareOptions fiware;

    /** @return null without these options */
    Evaluation.Target target() throws IOException {
        if (kafka == null) {
            return null;
        }
        Properties client = new Properties();
        if (properties != null) {
            try (Reader reader = Files.newBufferedReader(properties)) {
                client.load(reader);
            }
        }
        client.setProperty("bootstrap.servers", kafka);
        return new Evaluation.Target(fiware.settings(), client, false);
    }

    /** Describes the suite and the versions that its servers report. */
    List<String> setting(FleetSettings servers) {
        URI orion = servers.contextBroker();
        URI iotAgent = servers.iotAgent();
        return List.of(
                "A running suite, Kafka at %s, with its own guarantees and checkpoints. Sender and reader run in a separate process."
                        .formatted(kafka),
                "Context broker at %s: %s.".formatted(orion, about(orion.resolve("/version"))),
                "IoT Agent at %s: %s.".formatted(iotAgent, about(iotAgent.resolve("/iot/about"))));
    }

    private static String about(URI uri) {
        RestClient.Answer answer = new RestClient().get(uri, Map.of());
        String version = answer.body().findPath("version").asText();
        return !answer.isSuccess() || version.isEmpty() ? "version not reported" : "version " + version;
    }
}
