package io.furrow.cli.field;

import java.io.IOException;
import java.nio.file.Path;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.cli.option.KafkaClient;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.ngsi.NgsiJson;

/** Options for commands that read or write the topic of fields directly, and their output format. */
public final class FieldsOptions {
    private enum Output {
        TABLE,
        JSON;

        /** As it is written on the command line. */
        @Override
        public String toString() {
            return name().toLowerCase(Locale.ROOT);
        }
    }

    @Spec(Spec.Target.MIXEE)
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            description = "Kafka that holds service.fields. Default: ${DEFAULT-VALUE}.")
    private String kafka = "127.0.0.1:9092";

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka clients, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--output",
            paramLabel = "FORM",
            defaultValue = "table",
            description = "table or json. Default: ${DEFAULT-VALUE}.")
    private Output output;

    public FieldsTopic topic() {
        return new FieldsTopic(KafkaClient.settings(kafka, kafkaProperties));
    }

    /** Prints lines or JSON, depending on the option. */
    public void print(List<String> lines, JsonNode json) throws IOException {
        if (output == Output.JSON) {
            spec.commandLine()
                    .getOut()
                    .println(NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(json));
        } else {
            lines.forEach(spec.commandLine().getOut()::println);
        }
        spec.commandLine().getOut().flush();
    }
}
