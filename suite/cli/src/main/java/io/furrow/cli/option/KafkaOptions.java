package io.furrow.cli.option;

import java.nio.file.Path;
import java.util.Properties;

import picocli.CommandLine.Option;

/** Options of a command that can read Kafka itself, past the control plane. */
public final class KafkaOptions {
    @Option(
            names = {"--kafka", "--bootstrap-servers"},
            paramLabel = "HOST:PORT",
            description = "Use this Kafka itself, not the control plane with its roles and its audit.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the clients of --kafka, for instance security settings.")
    private Path properties;

    public String address() {
        return kafka;
    }

    /** Settings of Kafka clients. @throws CommandException if the file cannot be read */
    public Properties client() {
        return KafkaClient.settings(kafka, properties);
    }
}
