package io.furrow.cli.command;

import java.io.IOException;
import java.util.ArrayList;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import org.apache.kafka.common.KafkaException;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;

import io.furrow.cli.catalog.CatalogTable;
import io.furrow.cli.catalog.StoredAssets;
import io.furrow.cli.catalog.StoredTable;
import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.control.client.ListLimit;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.HelpOption;
import io.furrow.cli.option.KafkaOptions;
import io.furrow.flink.job.FileSystemOptions;
import io.furrow.kafka.catalog.Catalog;
import io.furrow.model.ngsi.NgsiJson;
import io.furrow.model.text.FailureText;

/** {@code ./furrow catalog}. */
@Command(
        name = "catalog",
        abbreviateSynopsis = true,
        description = "Lists what there is, as ingest has counted it: missions, entity types, their "
                + "attributes with type, unit, range and rate, first and last time, sizes, images; and what is stored: "
                + "missions with --mongo, images with --images.")
public final class CatalogCommand implements Callable<Integer> {
    @Mixin
    private ControlOptions control;

    @Mixin
    private KafkaOptions kafka;

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

    @Option(names = "--domain", paramLabel = "NAME", description = "Only this domain.")
    private String domain;

    @Option(names = "--mission", paramLabel = "NAME", description = "Only this mission.")
    private String mission;

    @Mixin
    private final ListLimit limit = new ListLimit();

    @Mixin
    private HelpOption help;

    @Override
    public Integer call() {
        limit.check(control);
        return control.run(api -> {
            Map<String, ControlApi.Page> lists = new LinkedHashMap<>();
            lists.put("types", control.isGiven("--kafka") ? selected(readCatalog()) : list(api));
            if (mongo != null) {
                lists.put("missions", selected(StoredAssets.missions(mongo)));
            }
            if (images != null) {
                lists.put("images", selected(storedImages()));
            }
            ObjectNode all = NgsiJson.object();
            lists.forEach((name, list) -> all.set(name, list.elements()));
            control.print(all, CatalogCommand::lines, any -> CatalogTable.names(any.path("types")));
            lists.values().stream()
                    .filter(ControlApi.Page::hasMore)
                    .findFirst()
                    .ifPresent(list -> limit.remark(control, list));
        });
    }

    private static List<String> lines(JsonNode all) {
        List<String> lines = new ArrayList<>(CatalogTable.lines(entries(all, "types")));
        if (all.has("missions")) {
            lines.addAll(StoredTable.missions(entries(all, "missions")));
        }
        if (all.has("images")) {
            lines.addAll(StoredTable.images(entries(all, "images")));
        }
        return lines;
    }

    private static List<JsonNode> entries(JsonNode all, String name) {
        return all.path(name).valueStream().toList();
    }

    private ControlApi.Page list(ControlApi api) {
        Map<String, String> only = new LinkedHashMap<>();
        only.put("domain", domain);
        only.put("mission", mission);
        return limit.read(api, "/api/catalog" + ControlApi.query(only));
    }

    private List<JsonNode> readCatalog() throws IOException {
        try {
            return Catalog.read(kafka.client());
        } catch (KafkaException e) {
            throw new CommandException(
                    "Kafka at %s cannot be read (%s). Check the address given with --kafka, and that it runs."
                            .formatted(kafka.address(), FailureText.of(e)),
                    e);
        }
    }

    private List<JsonNode> storedImages() throws IOException {
        fileSystems.initialize();
        return StoredAssets.images(images);
    }

    /** Returns the entries that match the options; MongoDB has no domains. */
    private ControlApi.Page selected(List<JsonNode> entries) {
        return limit.cut(NgsiJson.array()
                .addAll(entries.stream()
                        .filter(entry -> Catalog.isOf(entry, domain, mission))
                        .toList()));
    }
}
