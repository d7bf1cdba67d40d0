package io.furrow.cli.control.table;

import java.io.UncheckedIOException;
import java.util.ArrayList;
import java.util.List;
import java.util.StringJoiner;

import com.fasterxml.jackson.core.JsonProcessingException;
import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;

/** Prints records of topics: a page for one, or a line. */
public final class RecordPage {
    private static final List<String> MEMBERS = List.of("reason", "stage", "message", "source", "key", "size");

    private RecordPage() {}

    /** A record, or a dead letter, with its headers and its value. */
    public static List<String> of(JsonNode record) {
        List<String> lines = new ArrayList<>();
        lines.add("record   " + place(record));
        lines.add("time     " + Times.of(record.path("time")));
        MEMBERS.stream()
                .filter(record::hasNonNull)
                .forEach(member -> lines.add("%-8s %s".formatted(member, text(record.path(member)))));
        lines.add("headers");
        record.path("headers")
                .properties()
                .forEach(header -> lines.add("  %s: %s"
                        .formatted(
                                ControlTable.printable(header.getKey()),
                                ControlTable.printable(header.getValue().asText()))));
        if (record.has("value")) {
            lines.add("value, as " + record.path("encoding").asText()
                    + (record.path("cut").asBoolean() ? ", the beginning only" : ""));
            lines.addAll(value(record.path("value")));
        }
        return lines;
    }

    private static List<String> value(JsonNode value) {
        try {
            String text = value.isContainerNode()
                    ? NgsiJson.mapper().writerWithDefaultPrettyPrinter().writeValueAsString(value)
                    : value.asText();
            return text.lines().map(ControlTable::printable).toList();
        } catch (JsonProcessingException e) { // it was read from JSON
            throw new UncheckedIOException(e);
        }
    }

    /** Where it is, as show takes it. */
    public static String place(JsonNode record) {
        return "%s-%s@%s"
                .formatted(
                        record.path("topic").asText(),
                        record.path("partition").asText(),
                        record.path("offset").asText());
    }

    /** Place, time, key and value. */
    public static String line(JsonNode record) {
        return "%s  %s  %s  %s"
                .formatted(
                        place(record),
                        Times.of(record.path("time")),
                        text(record.path("key")),
                        text(record.path("value")));
    }

    /** Time, tenant and attributes of a report. */
    public static String report(JsonNode record) {
        JsonNode service = record.at("/headers/fiware-service");
        StringJoiner report = new StringJoiner("  ");
        report.add(Times.of(record.path("time")));
        if (!service.asText().isEmpty()) {
            report.add("service=" + text(service));
        }
        record.path("value").properties().forEach(member -> {
            if (member.getValue().has("value")) {
                report.add(ControlTable.printable(member.getKey()) + "="
                        + text(member.getValue().get("value")));
            }
        });
        return report.toString();
    }

    static String text(JsonNode value) {
        return value.isMissingNode() || value.isNull() ? "-" : ControlTable.printable(ControlTable.textOf(value));
    }
}
