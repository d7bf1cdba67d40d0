package io.furrow.cli.catalog;

import java.time.Duration;
import java.util.ArrayList;
import java.util.List;
import java.util.Locale;

import com.fasterxml.jackson.databind.JsonNode;

import io.furrow.cli.time.Times;

/** Prints stored data as text: a line for each mission in MongoDB, and for the images of each domain and mission. */
public final class StoredTable {
    private static final String MISSION = "%-28s %10s %9s  %-25s  %-25s  %-10s  %s";
    private static final String IMAGES = "%-28s %10s %10s %9s";

    private StoredTable() {}

    /** @param lines as of {@link StoredAssets#missions} */
    public static List<String> missions(List<JsonNode> lines) {
        List<String> table = new ArrayList<>(List.of(""));
        table.add(line(MISSION, "MISSION IN MONGODB", "DOCUMENTS", "SIZE", "FIRST", "LAST", "RETENTION", "INDEXES"));
        for (JsonNode one : lines) {
            List<String> indexes = new ArrayList<>();
            one.path("indexes").forEach(index -> indexes.add(index.asText()));
            table.add(line(
                    MISSION,
                    one.path("mission").asText(),
                    one.path("documents").asText(),
                    one.path("bytes").asLong() < 0
                            ? "?"
                            : CatalogTable.size(one.path("bytes").asLong()),
                    Times.of(one.path("first")),
                    Times.of(one.path("last")),
                    one.has("retentionSeconds")
                            ? retention(one.path("retentionSeconds").asLong())
                            : "-",
                    String.join(", ", indexes)));
        }
        return table;
    }

    /** @param lines as of {@link StoredAssets#images} */
    public static List<String> images(List<JsonNode> lines) {
        List<String> table = new ArrayList<>(List.of(""));
        table.add(line(IMAGES, "IMAGES IN FILES", "ENTITIES", "IMAGES", "SIZE"));
        for (JsonNode one : lines) {
            table.add(line(
                    IMAGES,
                    CatalogTable.place(one),
                    one.path("entities").asText(),
                    one.path("images").asText(),
                    CatalogTable.size(one.path("bytes").asLong())));
        }
        return table;
    }

    private static String retention(long seconds) {
        long day = Duration.ofDays(1).toSeconds();
        return seconds % day == 0 ? seconds / day + "d" : seconds + "s";
    }

    private static String line(String format, Object... cells) {
        return String.format(Locale.ROOT, format, cells).stripTrailing();
    }
}
