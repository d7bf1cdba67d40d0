package io.furrow.cli.command;

import java.io.IOException;
import java.nio.file.Path;
import java.time.Instant;
import java.time.temporal.ChronoUnit;
import java.util.LinkedHashMap;
import java.util.List;
import java.util.Map;
import java.util.concurrent.Callable;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import picocli.CommandLine.Command;
import picocli.CommandLine.Mixin;
import picocli.CommandLine.Option;
import picocli.CommandLine.Parameters;

import io.furrow.cli.control.client.ControlApi;
import io.furrow.cli.control.client.ControlOptions;
import io.furrow.cli.field.FieldList;
import io.furrow.cli.field.FieldReport;
import io.furrow.cli.option.CommandException;
import io.furrow.cli.option.KafkaOptions;
import io.furrow.fields.FieldFiles;
import io.furrow.kafka.field.FieldChange;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.ngsi.NgsiJson;

/** {@code ./furrow fields import}. */
@Command(
        name = "import",
        description = {
            "Reads fields from GeoJSON, a Shapefile or a GeoPackage in any coordinate system and sends them to the "
                    + "control plane as longitude and latitude in WGS 84. Edges stay straight between their corners; the "
                    + "report gives the error.",
            "Repairable features are repaired and reported; others are refused with the reason, and the exit "
                    + "code is 1. An unchanged field is not written again."
        })
final class FieldsImportCommand implements Callable<Integer> {
    @Mixin
    private ControlOptions control;

    @Mixin
    private KafkaOptions kafka;

    @Parameters(paramLabel = "FILE", description = "A .geojson, .shp (with .dbf and .prj beside it) or .gpkg file.")
    private Path file;

    @Option(
            names = "--id-property",
            paramLabel = "NAME",
            description = "Attribute that holds the ids. Default: the feature's own id, else the attribute id.")
    private String idProperty;

    @Option(
            names = "--name-property",
            paramLabel = "NAME",
            description = "Attribute that holds the names. Default: name.")
    private String nameProperty;

    @Option(
            names = "--domain",
            paramLabel = "NAME",
            description = "The domain of all of them. Default: the attribute Domain.")
    private String domain;

    @Option(
            names = "--valid-from",
            paramLabel = "TIME",
            description =
                    "Event time from which the fields are valid, for instance 2026-03-01T00:00:00Z. Default: now.")
    private Instant validFrom = Instant.now().truncatedTo(ChronoUnit.MILLIS);

    @Option(names = "--layer", paramLabel = "NAME", description = "Layer of a GeoPackage that has several.")
    private String layer;

    @Option(
            names = "--crs",
            paramLabel = "CODE",
            description =
                    "Coordinate system of the file, instead of the one that it names, for instance EPSG:25830. Easting "
                            + "or longitude come first, whatever the system defines.")
    private String crs;

    @Option(
            names = "--replace",
            description =
                    "Ends each field that is not in the file: of the domain of --domain, or without that option of the "
                            + "whole farm. --dry-run names them.")
    private boolean replace;

    @Option(names = "--dry-run", description = "Shows the changes and writes nothing.")
    private boolean dryRun;

    @Override
    public Integer call() {
        FieldFile read = read();
        boolean unsafe = replace && !read.refused().isEmpty();
        boolean writes = !dryRun && !unsafe;
        int code = control.run(api -> {
            FieldReport report = new FieldReport(
                    read,
                    control.isGiven("--kafka") ? store(read, writes) : send(api, read, writes),
                    validFrom,
                    writes);
            control.print(report.json(), any -> report.lines(), FieldReport::names);
        });
        if (unsafe) {
            control.warn("With --replace nothing is written while features are refused, because their fields would"
                    + " end. Mend the file, or leave out --replace.");
        }
        return read.refused().isEmpty() ? code : 1;
    }

    private FieldFile read() {
        try {
            return FieldFiles.read(file, new ImportOptions(layer, crs, idProperty, nameProperty, domain, validFrom));
        } catch (InvalidFileException e) {
            throw new CommandException(e.getMessage(), e);
        }
    }

    private static List<FieldVersion> versions(FieldFile read) {
        return read.fields().stream().map(ImportedField::version).toList();
    }

    /** Returns the changes of the control plane. */
    private JsonNode send(ControlApi api, FieldFile read, boolean writes) {
        Map<String, Object> query = new LinkedHashMap<>();
        query.put("domain", domain);
        query.put("validFrom", validFrom);
        query.put("replace", replace ? true : null);
        query.put("dryRun", writes ? null : true);
        return api.send(
                        "POST",
                        FieldsCommandGroup.FIELDS + ControlApi.query(query),
                        FieldList.json(FieldList.features(versions(read))))
                .path("fields");
    }

    /** Returns the changes of the topic. */
    private JsonNode store(FieldFile read, boolean writes) throws IOException {
        FieldsTopic topic = new FieldsTopic(kafka.client());
        List<FieldChange> changes = FieldChange.of(
                versions(read),
                topic.read(),
                field -> replace && (domain == null || domain.equals(field.domain())),
                validFrom.toEpochMilli());
        if (writes) {
            topic.write(FieldChange.toWrite(changes));
        }
        ArrayNode json = NgsiJson.array();
        changes.forEach(change -> json.add(change.toJson()));
        return json;
    }
}
