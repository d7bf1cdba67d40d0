package io.furrow.cli.command;

import java.io.IOException;
import java.io.PrintWriter;
import java.nio.file.Path;
import java.util.List;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.common.KafkaException;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Model.CommandSpec;
import picocli.CommandLine.Option;
import picocli.CommandLine.Spec;

import io.furrow.cli.catalog.CatalogTable;
import io.furrow.cli.catalog.StoredAssets;
import io.furrow.cli.catalog.StoredTable;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.option.KafkaClient;
import io.furrow.cli.option.OutputOptions;
import io.furrow.flink.job.FileSystemOptions;
import io.furrow.kafka.catalog.Catalog;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** {@code ./furrow catalog}. */
@Command(
        name = "catalog",
        abbreviateSynopsis = true,
        description = "Lists the content of the topic data.catalog, which ingest writes: missions, entity types, their "
                + "attributes with type, unit, range and rate, first and last time, sizes, images; and what is stored: "
                + "missions with --mongo, images with --images.")
public final class CatalogCommand implements Callable<Integer> {
    @Spec
    private CommandSpec spec;

    @Option(
            names = "--kafka",
            paramLabel = "HOST:PORT",
            defaultValue = KafkaClient.DEFAULT,
            description = "Kafka to read from. " + KafkaClient.DEFAULTS)
    private String kafka;

    @Option(
            names = "--kafka-properties",
            paramLabel = "FILE",
            description = "Properties for the Kafka client, for instance security settings.")
    private Path kafkaProperties;

    @Option(
            names = "--mongo",
            paramLabel = "URI",
            description = "Also list the missions in this MongoDB, for instance mongodb://127.0.0.1:27017. "
                    + "@FILE reads the URI, and so its password, from a file.")
    private String mongo;

    @Option(
            names = "--images",
            paramLabel = "URI",
            description = "Also count the images in this folder, that of the option --images of ingest.")
    private String images;

    @Mixin
    private final FileSystemOptions fileSystems = new FileSystemOptions();

    @Mixin
    private final OutputOptions output = new OutputOptions();

    @Option(names = "--domain", paramLabel = "NAME", description = "Only this domain.")
    private String domain;

    @Option(names = "--mission", paramLabel = "NAME", description = "Only this mission.")
    private String mission;

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        try {
            show();
            return 0;
        } catch (IOException e) {
            throw new CommandException(FailureText.of(e), e);
        }
    }

    private void show() throws IOException {
        List<JsonNode> types = entries(readCatalog());
        List<JsonNode> missions = mongo == null ? null : entries(StoredAssets.missions(mongo));
        List<JsonNode> stored = images == null ? null : entries(storedImages());
        PrintWriter out = spec.commandLine().getOut();
        if (!output.isForPeople()) {
            ObjectNode all = NgsiJson.mapper().createObjectNode();
            put(all, "types", types);
            put(all, "missions", missions);
            put(all, "images", stored);
            out.println(output.text(all));
        } else {
            output.table(CatalogTable.lines(types)).forEach(out::println);
            if (missions != null) {
                output.table(StoredTable.missions(missions)).forEach(out::println);
            }
            if (stored != null) {
                output.table(StoredTable.images(stored)).forEach(out::println);
            }
        }
        out.flush();
    }

    private List<JsonNode> readCatalog() throws IOException {
        try {
            return Catalog.read(KafkaClient.settings(kafka, kafkaProperties));
        } catch (KafkaException e) {
            throw new IOException(
                    "Kafka at %s cannot be read (%s). Check the address given with --kafka, and that it runs."
                            .formatted(kafka, FailureText.of(e)),
                    e);
        }
    }

    private List<JsonNode> storedImages() throws IOException {
        fileSystems.initialize();
        return StoredAssets.images(images);
    }

    /** The entries that match the options; MongoDB has no domains. */
    private List<JsonNode> entries(List<JsonNode> all) {
        return all.stream()
                .filter(entry -> Catalog.isOf(entry, domain, mission))
                .toList();
    }

    private static void put(ObjectNode all, String name, List<JsonNode> entries) {
        if (entries != null) {
            all.putArray(name).addAll(entries);
        }
    }
}
