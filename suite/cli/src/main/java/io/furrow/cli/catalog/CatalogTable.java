package io.furrow.cli.catalog;

import java.util.ArrayList;
import java.util.List;
import java.util.Locale;
import java.util.Map;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;

/** The catalog as text: a line for each type of a mission, and one for each of its attributes. */
public final class CatalogTable {
    private static final String ENTRY = "%-28s %-22s %8s %10s %9s %8s %9s  %-25s  %-25s";
    private static final String ATTRIBUTE = "    %-24s %-22s %8s %10s %9s %18s  %-25s  %-25s";

    private CatalogTable() {}

    public static List<String> lines(List<JsonNode> entries) {
        List<String> lines = new ArrayList<>();
        if (entries.isEmpty()) {
            return List.of("Nothing is stored yet.");
        }
        lines.add(line(
                ENTRY, "DOMAIN / MISSION", "TYPE", "ENTITIES", "EVENTS", "SIZE", "IMAGES", "OF SIZE", "FIRST", "LAST"));
        lines.add(line(ATTRIBUTE, "attribute", "type, kind", "unit", "values", "per s", "range", "first", "last"));
        for (JsonNode entry : entries) {
            lines.add(line(
                    ENTRY,
                    place(entry),
                    entry.path("type").asText(),
                    entry.path("entities").asText(),
                    entry.path("events").asText(),
                    size(entry.path("bytes").asLong()),
                    entry.path("images").asText(),
                    size(entry.path("imageBytes").asLong()),
                    Times.of(entry.path("first")),
                    Times.of(entry.path("last"))
                            + (entry.has("deleted") ? "  deleted " + Times.of(entry.path("deleted")) : "")));
            for (Map.Entry<String, JsonNode> attribute :
                    entry.path("attributes").properties()) {
                lines.add(attribute(attribute.getKey(), attribute.getValue()));
            }
        }
        return lines;
    }

    private static String attribute(String name, JsonNode profile) {
        return line(
                ATTRIBUTE,
                name,
                (profile.path("type").asText() + ", " + profile.path("kind").asText()).replaceFirst("^, ", ""),
                profile.path("unit").asText(),
                profile.path("values").asText(),
                profile.has("rate")
                        ? String.format(
                                Locale.ROOT, "%.3f", profile.path("rate").asDouble())
                        : "",
                profile.has("min")
                        ? profile.path("min").asText() + " … "
                                + profile.path("max").asText()
                        : "",
                Times.of(profile.path("first")),
                Times.of(profile.path("last")));
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

    private static String line(String format, Object... cells) {
        return String.format(Locale.ROOT, format, cells).stripTrailing();
    }
}
