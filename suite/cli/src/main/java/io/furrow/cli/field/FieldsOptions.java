package io.furrow.cli.field;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.KafkaClient;
import io.furrow.cli.option.OutputOptions;
import io.furrow.kafka.field.FieldsTopic;

/** Options for commands that read or write the topic of fields directly, and their output format. */
public final class FieldsOptions {
    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            defaultValue = KafkaClient.DEFAULT,
            description = "Kafka that holds service.fields. " + KafkaClient.DEFAULTS)
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka clients, for instance security settings.")
    private Path kafkaProperties;

    @Mixin
    private final OutputOptions output = new OutputOptions();

    public FieldsTopic topic() {
        return new FieldsTopic(KafkaClient.settings(kafka, kafkaProperties));
    }

    /** Prints lines, ids, JSON or YAML, depending on the option. */
    public void print(List<String> lines, JsonNode json) throws IOException {
        output.print(
                spec.commandLine().getOut(),
                json,
                lines,
                json.path("features")
                        .valueStream()
                        .map(field -> field.path("id").asText())
                        .toList());
    }
}
