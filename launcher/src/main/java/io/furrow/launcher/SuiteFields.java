package io.furrow.launcher;

import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.nio.file.StandardCopyOption;
import java.time.Instant;
import java.util.List;

import io.furrow.control.field.FieldChange;
import io.furrow.control.field.FieldFile;
import io.furrow.control.field.FieldsTopic;
import io.furrow.control.field.ImportOptions;
import io.furrow.control.field.ImportedField;
import io.furrow.control.field.RefusedFeature;
import io.furrow.control.field.UnusableFileException;
import io.furrow.model.field.FieldVersion;
import io.furrow.simulators.fiware.FiwareStandIn;

/**
 * The fields with which a suite starts, on {@code service.fields} as {@code ./furrow fields import} would put them there, valid from
 * the beginning of time: what is imported while the suite runs comes after them.
 */
final class SuiteFields {
    private static final String DEMO = "/io/furrow/simulators/demo/fields.geojson";

    private final FieldsTopic topic;

    SuiteFields(FieldsTopic topic) {
        this.topic = topic;
    }

    /**
     * Reads the settings' file before anything is started for it.
     *
     * @throws SuiteNotStartedException if the file cannot be used wholly
     */
    static void requireUsable(SuiteSettings settings) {
        if (settings.fields() != null) {
            read(settings.fields());
        }
    }

    /**
     * Writes the fields of the settings' file; without one those of the demonstration farm, if the broker is the suite's own and
     * has no fields yet.
     *
     * @throws SuiteNotStartedException if the file cannot be used wholly
     */
    List<FieldVersion> write(SuiteSettings settings, RunDirectory directory) throws IOException {
        Path file = settings.fields();
        List<FieldVersion> known = topic.read();
        boolean isOwnBroker = settings.kafka() == null;
        if (file == null && !(isOwnBroker && known.isEmpty())) {
            return List.of();
        }
        List<FieldVersion> wanted = file == null ? read(demo(directory)) : read(file);
        List<FieldVersion> changed = FieldChange.of(wanted, known, false, Instant.EPOCH.toEpochMilli()).stream()
                .filter(change -> change.kind() != FieldChange.Kind.UNCHANGED)
                .map(FieldChange::version)
                .toList();
        topic.write(changed);
        return changed;
    }

    private static List<FieldVersion> read(Path file) {
        try {
            FieldFile read = FieldFile.read(file, new ImportOptions(null, null, null, null, null, Instant.EPOCH));
            if (!read.refused().isEmpty()) {
                RefusedFeature first = read.refused().get(0);
                throw new SuiteNotStartedException(
                        "--fields %s: feature %d %s".formatted(file, first.number(), first.reason()));
            }
            return read.fields().stream().map(ImportedField::version).toList();
        } catch (UnusableFileException e) {
            throw new SuiteNotStartedException("--fields " + e.getMessage(), e);
        }
    }

    private static Path demo(RunDirectory directory) throws IOException {
        Path file = directory.resolve("fields.geojson");
        try (InputStream demo = FiwareStandIn.class.getResourceAsStream(DEMO)) {
            Files.copy(demo, file, StandardCopyOption.REPLACE_EXISTING);
        }
        return file;
    }
}
