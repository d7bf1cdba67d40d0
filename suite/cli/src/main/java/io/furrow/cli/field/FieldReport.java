package io.furrow.cli.field;

import java.nio.charset.StandardCharsets;
import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.util.RawValue;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.kafka.field.FieldChange;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.RejectedFeature;
import io.furrow.model.ngsi.NgsiJson;

/** Reports per field what an import did and did not do; also prints lists of fields. */
public final class FieldReport {
    private static final String NO_DOMAIN = "no domain";

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
        lines.addAll(new ControlTable("The file has no features.")
                .text("CHANGE", "/change")
                .text("ID", "/id")
                .text("NAME", "/name")
                .text("DOMAIN", "/domain")
                .text("AREA ha", "/hectares")
                .text("MENDED", "/notes")
                .lines(rows()));
        lines.add(String.format(
                Locale.ROOT,
                "%s: %d added, %d changed, %d unchanged, %d ended%s, %d refused; valid from %s",
                written ? "Written" : "Not written",
                count(FieldChange.Kind.ADDED),
                count(FieldChange.Kind.CHANGED),
                count(FieldChange.Kind.UNCHANGED),
                count(FieldChange.Kind.ENDED),
                endedByDomain(),
                file.refused().size(),
                validFrom));
        return lines;
    }

    private ArrayNode rows() {
        ArrayNode rows = NgsiJson.mapper().createArrayNode();
        for (FieldChange change : changes) {
            FieldVersion shown = shown(change);
            ObjectNode row = rows.addObject().put("change", code(change)).put("id", shown.id());
            row.put("name", nullIfEmpty(shown.name())).put("domain", nullIfEmpty(shown.domain()));
            if (change.before() != null && !change.before().domain().equals(shown.domain())) {
                row.put("domain", named(change.before().domain()) + " → " + named(shown.domain()));
            }
            ImportedField field = fields.get(shown.id());
            if (field != null) {
                row.put("hectares", String.format(Locale.ROOT, "%.4f", field.hectares()))
                        .put("notes", nullIfEmpty(String.join("; ", field.notes())));
            }
        }
        for (RejectedFeature refused : file.refused()) {
            rows.addObject()
                    .put("change", "REFUSED")
                    .put("id", nullIfEmpty(refused.id()))
                    .put("name", "feature " + refused.number())
                    .put("notes", refused.reason());
        }
        return rows;
    }

    /** Of an ended field, the previous version. */
    private static FieldVersion shown(FieldChange change) {
        return change.kind() == FieldChange.Kind.ENDED ? change.before() : change.version();
    }

    private static String code(FieldChange change) {
        return change.kind().name().toLowerCase(Locale.ROOT);
    }

    private static String nullIfEmpty(String text) {
        return text.isEmpty() ? null : text;
    }

    private static String named(String domain) {
        return domain.isEmpty() ? NO_DOMAIN : domain;
    }

    /** For instance {@code (north 2, south 1)}; empty if no field ends. */
    private String endedByDomain() {
        Map<String, Long> ended = changes.stream()
                .filter(change -> change.kind() == FieldChange.Kind.ENDED)
                .collect(Collectors.groupingBy(
                        change -> named(change.before().domain()), TreeMap::new, Collectors.counting()));
        return ended.isEmpty()
                ? ""
                : ended.entrySet().stream()
                        .map(each -> each.getKey() + " " + each.getValue())
                        .collect(Collectors.joining(", ", " (", ")"));
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
            FieldVersion shown = shown(change);
            ObjectNode one = all.addObject();
            one.put("id", shown.id()).put("name", shown.name()).put("domain", shown.domain());
            one.put("change", code(change));
            ImportedField field = fields.get(shown.id());
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
        ArrayNode rows = NgsiJson.mapper().createArrayNode();
        for (FieldVersion version : versions) {
            rows.addObject()
                    .put("id", version.id())
                    .put("name", nullIfEmpty(version.name()))
                    .put("domain", nullIfEmpty(version.domain()))
                    .put("validFrom", version.validFrom())
                    .put(
                            "shape",
                            version.isEnd()
                                    ? "ends"
                                    : version.geometry().path("type").asText());
        }
        return new ControlTable("There are no fields. Bring some with: ./furrow fields import FILE")
                .text("ID", "/id")
                .text("NAME", "/name")
                .text("DOMAIN", "/domain")
                .time("VALID FROM", "/validFrom")
                .text("SHAPE", "/shape")
                .lines(rows);
    }

    /** The versions as stored in the topic: a GeoJSON FeatureCollection. */
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
}
