package io.furrow.cli.catalog;

import java.util.ArrayList;
import java.util.Iterator;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.cli.time.Times;
import io.furrow.model.ngsi.NgsiJson;

/** The catalog as text: a line for each type of a mission, and one for each of its attributes. */
public final class CatalogTable {
    private static final ControlTable ENTRIES = new ControlTable("Nothing is stored yet.")
            .text("DOMAIN / MISSION", entry -> TextNode.valueOf(place(entry)))
            .text("TYPE", "/type")
            .text("ENTITIES", "/entities")
            .text("EVENTS", "/events")
            .text("SIZE", entry -> TextNode.valueOf(size(entry.path("bytes").asLong())))
            .text("IMAGES", "/images")
            .text(
                    "OF SIZE",
                    entry -> TextNode.valueOf(size(entry.path("imageBytes").asLong())))
            .time("FIRST", "/first")
            .text("LAST", entry -> TextNode.valueOf(last(entry)));
    private static final ControlTable ATTRIBUTES = new ControlTable("")
            .text("attribute", "/name")
            .text("type, kind", attribute -> TextNode.valueOf(kind(attribute)))
            .text("unit", "/unit")
            .text("values", "/values")
            .text("per s", CatalogTable::rate)
            .text("range", CatalogTable::range)
            .time("first", "/first")
            .time("last", "/last");
    private static final String INDENT = "    ";

    private CatalogTable() {}

    public static List<String> lines(List<JsonNode> entries) {
        List<List<ObjectNode>> attributes =
                entries.stream().map(CatalogTable::attributes).toList();
        List<String> entryLines = ENTRIES.lines(NgsiJson.array().addAll(entries));
        if (entries.isEmpty()) {
            return entryLines;
        }
        ArrayNode all = NgsiJson.array();
        attributes.forEach(all::addAll);
        Iterator<String> attributeLines = ATTRIBUTES.lines(all).iterator();
        List<String> lines = new ArrayList<>(List.of(entryLines.get(0)));
        if (!all.isEmpty()) {
            lines.add(INDENT + attributeLines.next());
        }
        for (int i = 0; i < entries.size(); i++) {
            lines.add(entryLines.get(i + 1));
            attributes.get(i).forEach(any -> lines.add(INDENT + attributeLines.next()));
        }
        return lines;
    }

    /** Domain, mission and type of each entry, as {@code north/weeding/Thermometer}. */
    public static List<String> names(JsonNode entries) {
        return entries.valueStream()
                .map(entry ->
                        place(entry).replace(" ", "") + "/" + entry.path("type").asText())
                .toList();
    }

    private static List<ObjectNode> attributes(JsonNode entry) {
        return entry.path("attributes").properties().stream()
                .map(each -> ((ObjectNode) each.getValue()).deepCopy().put("name", each.getKey()))
                .toList();
    }

    private static String last(JsonNode entry) {
        return Times.of(entry.path("last"))
                + (entry.has("deleted") ? "  deleted " + Times.of(entry.path("deleted")) : "");
    }

    private static String kind(JsonNode attribute) {
        return (attribute.path("type").asText() + ", " + attribute.path("kind").asText()).replaceFirst("^, ", "");
    }

    private static JsonNode rate(JsonNode attribute) {
        JsonNode rate = attribute.path("rate");
        return rate.isMissingNode() ? rate : TextNode.valueOf(String.format(Locale.ROOT, "%.3f", rate.asDouble()));
    }

    private static JsonNode range(JsonNode attribute) {
        JsonNode min = attribute.path("min");
        return min.isMissingNode()
                ? min
                : TextNode.valueOf(min.asText() + " … " + attribute.path("max").asText());
    }

    static String place(JsonNode entry) {
        String domain = entry.path("domain").asText();
        String mission = entry.path("mission").asText();
        return (domain.isEmpty() ? "-" : domain) + " / " + (mission.isEmpty() ? "-" : mission);
    }

    /** For instance {@code 1.2 MB}. */
    static String size(long bytes) {
        String[] units = {"B", "kB", "MB", "GB", "TB"};
        double size = bytes;
        int unit = 0;
        while (size >= 1000 && unit < units.length - 1) {
            size /= 1000;
            unit++;
        }
        return unit == 0 ? bytes + " B" : String.format(Locale.ROOT, "%.1f %s", size, units[unit]);
    }
}
