package io.furrow.cli.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.time.DateTimeException;
import java.time.Instant;
import java.time.OffsetDateTime;
import java.util.List;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.ITypeConverter;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.ScopeType;
import picocli.CommandLine.Spec;
import picocli.CommandLine.TypeConversionException;

import io.furrow.cli.CommandException;
import io.furrow.cli.KafkaClient;
import io.furrow.cli.field.FieldReport;
import io.furrow.fields.FieldChange;
import io.furrow.fields.FieldsTopic;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow fields}. */
@Command(
        name = "fields",
        description = "Imports and lists the fields of the farm, the topic service.fields.",
        synopsisSubcommandLabel = "COMMAND",
        subcommands = FieldsImportCommand.class)
public final class FieldsCommand extends CommandGroup {
    private enum Output {
        TABLE,
        JSON
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            scope = ScopeType.INHERIT,
            defaultValue = "127.0.0.1:9092",
            description = "Kafka that holds service.fields. Default: ${DEFAULT-VALUE}.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            scope = ScopeType.INHERIT,
            description = "Properties for the Kafka clients, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--output",
            paramLabel = "FORM",
            scope = ScopeType.INHERIT,
            defaultValue = "table",
            description = "table or json. Default: ${DEFAULT-VALUE}.")
    private Output output;

    @Command(name = "list", description = "Prints the fields as of a time.")
    int list(
            @Option(
                            names = "--at",
                            paramLabel = "TIME",
                            converter = TimeConverter.class,
                            description = "Event time, for instance 2026-03-01T00:00:00Z. Default: now.")
                    Instant at,
            @Option(names = "--versions", description = "All versions of all times, ends too.") boolean versions) {
        try {
            List<FieldVersion> known = topic().read();
            Instant time = at == null ? Instant.now() : at;
            List<FieldVersion> shown = versions
                    ? known
                    : List.copyOf(FieldChange.asOf(time.toEpochMilli(), known).values());
            print(FieldReport.lines(shown), FieldReport.json(shown));
            return 0;
        } catch (IOException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    /** As the option says: lines or JSON. */
    void print(List<String> lines, JsonNode json) {
        if (output == Output.JSON) {
            out().println(pretty(json));
        } else {
            lines.forEach(out()::println);
        }
        out().flush();
    }

    private static String pretty(JsonNode json) {
        try {
            return NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(json);
        } catch (JsonProcessingException e) {
            throw new IllegalStateException("a tree of JSON cannot be written", e);
        }
    }

    FieldsTopic topic() {
        return new FieldsTopic(KafkaClient.settings(kafka, kafkaProperties));
    }

    private PrintWriter out() {
        return spec.commandLine().getOut();
    }

    /** ISO 8601 with an offset. */
    static final class TimeConverter implements ITypeConverter<Instant> {
        @Override
        public Instant convert(String value) {
            try {
                return OffsetDateTime.parse(value).toInstant();
            } catch (DateTimeException e) {
                throw new TypeConversionException(
                        "'" + value + "' is no time; write for instance 2026-03-01T00:00:00Z");
            }
        }
    }
}
