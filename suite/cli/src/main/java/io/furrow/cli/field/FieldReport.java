package io.furrow.cli.field;

import java.time.Instant;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;
import java.util.TreeMap;
import java.util.function.Function;
import java.util.stream.Collectors;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.kafka.field.FieldChange;
import io.furrow.model.field.FieldFile;
import io.furrow.model.field.ImportedField;
import io.furrow.model.field.RejectedFeature;
import io.furrow.model.ngsi.NgsiJson;

/** Reports per field what an import did and did not do. */
public final class FieldReport {
    private static final String NO_DOMAIN = "no domain";

    private final FieldFile file;
    private final JsonNode changes;
    private final Instant validFrom;
    private final boolean written;
    private final Map<String, ImportedField> fields;

    /** @param changes a list, each as of {@link FieldChange#toJson} */
    public FieldReport(FieldFile file, JsonNode changes, Instant validFrom, boolean written) {
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
        for (JsonNode change : changes) {
            ObjectNode row = rows.addObject();
            row.set("change", change.path("change"));
            row.set("id", change.path("id"));
            row.put("name", nullIfEmpty(change.path("name").asText()));
            String domain = change.path("domain").asText();
            row.put(
                    "domain",
                    change.has("domainBefore")
                            ? named(change.path("domainBefore").asText()) + " → " + named(domain)
                            : nullIfEmpty(domain));
            ImportedField field = fields.get(change.path("id").asText());
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

    private static String nullIfEmpty(String text) {
        return text.isEmpty() ? null : text;
    }

    private static String named(String domain) {
        return domain.isEmpty() ? NO_DOMAIN : domain;
    }

    /** For instance {@code (north 2, south 1)}; empty if no field ends. */
    private String endedByDomain() {
        Map<String, Long> ended = changes.valueStream()
                .filter(change -> is(change, FieldChange.Kind.ENDED))
                .collect(Collectors.groupingBy(
                        change -> named(change.path("domain").asText()), TreeMap::new, Collectors.counting()));
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
        for (JsonNode change : changes) {
            ObjectNode one = all.addObject();
            for (String member : List.of("id", "name", "domain", "change")) {
                one.set(member, change.path(member));
            }
            ImportedField field = fields.get(change.path("id").asText());
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

    /** @param report as of {@link #json} */
    public static List<String> names(JsonNode report) {
        return report.path("fields")
                .valueStream()
                .map(field -> field.path("id").asText())
                .toList();
    }

    private double edgeError() {
        return file.fields().stream()
                .mapToDouble(ImportedField::edgeErrorMeters)
                .max()
                .orElse(0);
    }

    private long count(FieldChange.Kind kind) {
        return changes.valueStream().filter(change -> is(change, kind)).count();
    }

    private static boolean is(JsonNode change, FieldChange.Kind kind) {
        return change.path("change").asText().equalsIgnoreCase(kind.name());
    }
}
