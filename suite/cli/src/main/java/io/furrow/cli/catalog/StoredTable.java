package io.furrow.cli.catalog;

import java.time.Duration;
import java.util.List;
import java.util.stream.Collectors;
import java.util.stream.Stream;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.model.ngsi.NgsiJson;

/** Prints stored data as text: a line for each mission in MongoDB, and for the images of each domain and mission. */
public final class StoredTable {
    private static final ControlTable MISSIONS = new ControlTable("There is no mission in MongoDB.")
            .text("MISSION IN MONGODB", "/mission")
            .text("DOCUMENTS", "/documents")
            .text("SIZE", mission -> size(mission.path("bytes").asLong()))
            .time("FIRST", "/first")
            .time("LAST", "/last")
            .text("RETENTION", mission -> retention(mission.path("retentionSeconds")))
            .text("INDEXES", mission -> indexes(mission.path("indexes")));
    private static final ControlTable IMAGES = new ControlTable("There are no images.")
            .text("IMAGES IN FILES", usage -> TextNode.valueOf(CatalogTable.place(usage)))
            .text("ENTITIES", "/entities")
            .text("IMAGES", "/images")
            .text("SIZE", usage -> size(usage.path("bytes").asLong()));

    private StoredTable() {}

    /** @param lines as of {@link StoredAssets#missions} */
    public static List<String> missions(List<JsonNode> lines) {
        return below(MISSIONS.lines(NgsiJson.array().addAll(lines)));
    }

    /** @param lines as of {@link StoredAssets#images} */
    public static List<String> images(List<JsonNode> lines) {
        return below(IMAGES.lines(NgsiJson.array().addAll(lines)));
    }

    /** With an empty line before it. */
    private static List<String> below(List<String> table) {
        return Stream.concat(Stream.of(""), table.stream()).toList();
    }

    /** @param bytes -1 if unknown */
    private static JsonNode size(long bytes) {
        return TextNode.valueOf(bytes < 0 ? "?" : CatalogTable.size(bytes));
    }

    private static JsonNode retention(JsonNode retention) {
        long day = Duration.ofDays(1).toSeconds();
        long seconds = retention.asLong();
        return retention.isMissingNode()
                ? retention
                : TextNode.valueOf(seconds % day == 0 ? seconds / day + "d" : seconds + "s");
    }

    private static JsonNode indexes(JsonNode indexes) {
        return TextNode.valueOf(indexes.valueStream().map(JsonNode::asText).collect(Collectors.joining(", ")));
    }
}
