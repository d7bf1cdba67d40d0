package io.furrow.launcher.suite;

import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.time.Instant;
import java.util.ArrayList;
import java.util.Comparator;
import java.util.List;
import java.util.Map;
import java.util.Optional;
import java.util.TreeMap;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.JsonNodeFactory;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.option.CommandException;
import io.furrow.fields.FieldFiles;
import io.furrow.fiware.FiwareStandIn;
import io.furrow.kafka.field.FieldChange;
import io.furrow.kafka.field.FieldsTopic;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.field.ImportOptions;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.InvalidFileException;
import io.furrow.model.field.RejectedFeature;
import io.furrow.model.ngsi.NgsiJson;

/**
 * The initial fields of a suite, written to {@code service.fields} as by {@code ./furrow fields import}, valid from the beginning of time:
 * imports at run time come after them.
 */
final class SuiteFields {
    /** In the run directory. */
    static final String ZONES = "zones.geojson";

    private static final int MAX_REPAIRS = 10;
    private static final String DEMO = "/io/furrow/simulators/demo/fields.geojson";

    private final FieldsTopic topic;

    SuiteFields(FieldsTopic topic) {
        this.topic = topic;
    }

    /**
     * Validates the settings' file before anything is started.
     *
     * @return the repairs, field by field
     * @throws CommandException if any part of the file is invalid
     */
    static List<String> requireUsable(SuiteSettings settings) {
        if (settings.fields() == null) {
            return List.of();
        }
        List<String> repairs = new ArrayList<>();
        for (ImportedField field : read(settings.fields())) {
            if (!field.notes().isEmpty()) {
                repairs.add("--fields: field %s: %s".formatted(field.version().id(), String.join("; ", field.notes())));
            }
        }
        if (repairs.size() > MAX_REPAIRS) {
            String rest = "--fields: %d more fields were repaired; ./furrow fields import --dry-run lists them"
                    .formatted(repairs.size() - MAX_REPAIRS);
            repairs.subList(MAX_REPAIRS, repairs.size()).clear();
            repairs.add(rest);
        }
        return repairs;
    }

    /**
     * Writes the fields of the settings' file as the initial ones of the farm, and ends other initial ones; without a file those of the
     * demonstration farm, if the broker is the suite's own and has no fields yet.
     *
     * @throws CommandException if any part of the file is invalid
     */
    List<FieldVersion> write(SuiteSettings settings, RunDirectory directory) throws IOException {
        Path file = settings.fields();
        List<FieldVersion> existing = topic.read();
        boolean isOwnBroker = settings.kafka() == null;
        if (file == null && !(isOwnBroker && existing.isEmpty())) {
            return List.of();
        }
        List<FieldVersion> desired = read(file == null ? demo(directory) : file).stream()
                .map(ImportedField::version)
                .toList();
        List<FieldVersion> changed = FieldChange.toWrite(
                FieldChange.of(desired, existing, field -> file != null, Instant.EPOCH.toEpochMilli()));
        topic.write(changed);
        return changed;
    }

    /**
     * Writes the current exclusion zones among the fields as a GeoJSON file for the job {@code collision}.
     *
     * @return empty if there are none
     */
    Optional<Path> zones(RunDirectory directory) throws IOException {
        Path file = directory.resolve(ZONES);
        Map<String, FieldVersion> newest = new TreeMap<>();
        long now = System.currentTimeMillis();
        topic.read().stream()
                .filter(version -> version.validFrom() <= now)
                .sorted(Comparator.comparingLong(FieldVersion::validFrom))
                .forEach(version -> newest.put(version.id(), version));
        ObjectNode zones = JsonNodeFactory.instance.objectNode().put("type", "FeatureCollection");
        ArrayNode features = zones.putArray("features");
        newest.values().stream()
                .filter(version -> version.isExclusion() && !version.isEnd())
                .forEach(version -> features.addObject().put("type", "Feature").set("geometry", version.geometry()));
        if (features.isEmpty()) {
            Files.deleteIfExists(file);
            return Optional.empty();
        }
        return Optional.of(Files.write(file, NgsiJson.write(zones)));
    }

    private static List<ImportedField> read(Path file) {
        try {
            FieldFile read = FieldFiles.read(file, new ImportOptions(null, null, null, null, null, Instant.EPOCH));
            if (!read.refused().isEmpty()) {
                RejectedFeature first = read.refused().get(0);
                throw new CommandException(
                        "--fields %s: feature %d %s".formatted(file, first.number(), withCommand(first.reason())));
            }
            return read.fields();
        } catch (InvalidFileException e) {
            throw new CommandException("--fields " + withCommand(e.getMessage()), e);
        }
    }

    /** Adapts a message of the import, whose options a suite does not have. */
    private static String withCommand(String reason) {
        return reason.replaceFirst("--[a-z]+(-[a-z]+)*", "the option $0 of ./furrow fields import");
    }

    private static Path demo(RunDirectory directory) throws IOException {
        Path file = directory.resolve("fields.geojson");
        try (InputStream demo = FiwareStandIn.class.getResourceAsStream(DEMO)) {
            Files.copy(demo, file, StandardCopyOption.REPLACE_EXISTING);
        }
        return file;
    }
}
