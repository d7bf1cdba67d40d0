package io.furrow.cli.field;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.function.Function;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.RawValue;

import io.furrow.fields.FieldChange;
import io.furrow.fields.ImportedField;
import io.furrow.fields.RefusedFeature;
import io.furrow.fields.file.FieldFile;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

/** What an import did, field by field, and what it did not; lists of fields too. */
public final class FieldReport {
    private static final String LINE = "%-10s %-24s %-24s %10s  %s";
    private static final String LISTED = "%-24s %-24s %-16s %-24s  %s";

    private final FieldFile file;
    private final List<FieldChange> changes;
    private final Instant validFrom;
    private final boolean written;
    private final Map<String, ImportedField> fields;

    public FieldReport(FieldFile file, List<FieldChange> changes, Instant validFrom, boolean written) {
        this.file = file;
        this.changes = changes;
        this.validFrom = validFrom;
        this.written = written;
        this.fields = file.fields().stream()
                .collect(Collectors.toMap(field -> field.version().id(), Function.identity()));
    }

    public List<String> lines() {
        List<String> lines = new ArrayList<>();
        lines.add(String.format(
                Locale.ROOT,
                "%s → WGS 84, accuracy of the change of datum %s; edges off by at most %.3f m",
                file.crs(),
                Double.isNaN(file.accuracyMeters()) ? "unknown" : file.accuracyMeters() + " m",
                edgeError()));
        lines.addAll(file.notes());
        lines.add(line(LINE, "", "ID", "NAME", "AREA ha", "MENDED"));
        for (FieldChange change : changes) {
            ImportedField field = fields.get(change.version().id());
            lines.add(line(
                    LINE,
                    change.kind().name().toLowerCase(Locale.ROOT),
                    change.version().id(),
                    change.version().name(),
                    field == null ? "" : String.format(Locale.ROOT, "%.4f", field.hectares()),
                    field == null ? "" : String.join("; ", field.notes())));
        }
        for (RefusedFeature refused : file.refused()) {
            lines.add(line(
                    LINE,
                    "REFUSED",
                    refused.id().isEmpty() ? "–" : refused.id(),
                    "feature " + refused.number(),
                    "",
                    refused.reason()));
        }
        lines.add(String.format(
                Locale.ROOT,
                "%s: %d added, %d changed, %d unchanged, %d ended, %d refused; valid from %s",
                written ? "Written" : "Not written",
                count(FieldChange.Kind.ADDED),
                count(FieldChange.Kind.CHANGED),
                count(FieldChange.Kind.UNCHANGED),
                count(FieldChange.Kind.ENDED),
                file.refused().size(),
                validFrom));
        return lines;
    }

    public ObjectNode json() {
        ObjectNode report = NgsiJson.mapper().createObjectNode();
        report.put("crs", file.crs()).put("validFrom", validFrom.toString()).put("written", written);
        if (!Double.isNaN(file.accuracyMeters())) {
            report.put("accuracyMeters", file.accuracyMeters());
        }
        file.notes().forEach(report.putArray("notes")::add);
        ArrayNode all = report.putArray("fields");
        for (FieldChange change : changes) {
            ObjectNode one = all.addObject();
            one.put("id", change.version().id()).put("name", change.version().name());
            one.put("change", change.kind().name().toLowerCase(Locale.ROOT));
            ImportedField field = fields.get(change.version().id());
            if (field != null) {
                one.put("feature", field.number()).put("hectares", field.hectares());
                one.put("edgeErrorMeters", field.edgeErrorMeters());
                field.notes().forEach(one.putArray("mended")::add);
            }
        }
        ArrayNode refused = report.putArray("refused");
        file.refused()
                .forEach(one -> refused.addObject()
                        .put("feature", one.number())
                        .put("id", one.id())
                        .put("reason", one.reason()));
        return report;
    }

    /** A table of versions. */
    public static List<String> lines(List<FieldVersion> versions) {
        if (versions.isEmpty()) {
            return List.of("There are no fields. Bring some with: ./furrow fields import FILE");
        }
        List<String> lines = new ArrayList<>();
        lines.add(line(LISTED, "ID", "NAME", "DOMAIN", "VALID FROM", "SHAPE"));
        for (FieldVersion version : versions) {
            lines.add(line(
                    LISTED,
                    version.id(),
                    version.name(),
                    version.domain(),
                    Instant.ofEpochMilli(version.validFrom()),
                    version.isEnd() ? "ends" : version.geometry().path("type").asText()));
        }
        return lines;
    }

    /** The versions as they lie in the topic: a GeoJSON FeatureCollection. */
    public static ObjectNode json(List<FieldVersion> versions) {
        ObjectNode collection = NgsiJson.mapper().createObjectNode().put("type", "FeatureCollection");
        ArrayNode features = collection.putArray("features");
        versions.forEach(
                version -> features.addRawValue(new RawValue(new String(version.toBytes(), StandardCharsets.UTF_8))));
        return collection;
    }

    private double edgeError() {
        return file.fields().stream()
                .mapToDouble(ImportedField::edgeErrorMeters)
                .max()
                .orElse(0);
    }

    private long count(FieldChange.Kind kind) {
        return changes.stream().filter(change -> change.kind() == kind).count();
    }

    private static String line(String format, Object... cells) {
        return String.format(Locale.ROOT, format, cells).stripTrailing();
    }
}
