package io.furrow.launcher;

import java.io.IOException;
import java.io.PrintWriter;
import java.io.Reader;
import java.nio.file.Files;
import java.nio.file.Path;
import java.util.List;
import java.util.Properties;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.launcher.catalog.Catalog;
import io.furrow.launcher.catalog.CatalogTable;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow catalog}. */
@Command(
        name = "catalog",
        abbreviateSynopsis = true,
        description =
                "Lists what is stored, from the topic data.catalog that ingest keeps: missions, types of entities, their "
                        + "attributes with type, unit, range and rate, first and last seen, sizes, images.")
final class CatalogCommand implements Callable<Integer> {
    private enum Output {
        TABLE,
        JSON
    }

    @Spec
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            defaultValue = "127.0.0.1:9092",
            description = "Kafka to read from. Default: ${DEFAULT-VALUE}.")
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka client, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--output",
            paramLabel = "FORM",
            defaultValue = "table",
            description = "table or json. Default: ${DEFAULT-VALUE}.")
    private Output output;

    @Option(names = "--domain", paramLabel = "NAME", description = "Only this domain.")
    private String domain;

    @Option(names = "--mission", paramLabel = "NAME", description = "Only this mission.")
    private String mission;

    @Option(
            names = {"-h", "--help"},
            usageHelp = true,
            description = "Show this text.")
    private boolean help;

    @Override
    public Integer call() throws IOException {
        List<JsonNode> entries = read().stream()
                .filter(entry ->
                        domain == null || domain.equals(entry.path("domain").asText()))
                .filter(entry ->
                        mission == null || mission.equals(entry.path("mission").asText()))
                .toList();
        PrintWriter out = spec.commandLine().getOut();
        if (output == Output.JSON) {
            ArrayNode all = NgsiJson.mapper().createArrayNode().addAll(entries);
            out.println(NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(all));
        } else {
            CatalogTable.lines(entries).forEach(out::println);
        }
        out.flush();
        return 0;
    }

    private List<JsonNode> read() {
        try {
            return Catalog.read(kafka, properties());
        } catch (IOException e) {
            throw new SuiteNotStartedException(e.getMessage(), e);
        }
    }

    private Properties properties() {
        Properties properties = new Properties();
        if (kafkaProperties == null) {
            return properties;
        }
        try (Reader reader = Files.newBufferedReader(kafkaProperties)) {
            properties.load(reader);
            return properties;
        } catch (IOException e) {
            throw new SuiteNotStartedException(
                    "--kafka-properties %s cannot be read; name a readable properties file".formatted(kafkaProperties),
                    e);
        }
    }
}
