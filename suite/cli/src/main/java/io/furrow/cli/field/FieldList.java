package io.furrow.cli.field;

import java.util.List;

import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.node.ArrayNode;
import com.fasterxml.jackson.databind.node.ObjectNode;
import com.fasterxml.jackson.databind.node.TextNode;

import io.furrow.cli.control.table.ControlTable;
import io.furrow.model.field.FieldVersion;
import io.furrow.model.ngsi.NgsiJson;

/** Lists of fields, as GeoJSON and as a table. */
public final class FieldList {
    private static final ControlTable TABLE = new ControlTable(
                    "There are no fields. Bring some with: ./furrow fields import FILE")
            .text("ID", "/id")
            .text("NAME", "/properties/name")
            .text("DOMAIN", "/properties/Domain")
            .time("VALID FROM", "/properties/validFrom")
            .text("SHAPE", field -> TextNode.valueOf(field.at("/geometry/type").asText("ends")));

    private FieldList() {}

    /** The versions as in {@code service.fields}. */
    public static ArrayNode features(List<FieldVersion> versions) {
        ArrayNode features = NgsiJson.array();
        versions.forEach(version -> features.add(NgsiJson.own(() -> NgsiJson.read(version.toBytes()))));
        return features;
    }

    /** Returns a FeatureCollection. */
    public static ObjectNode json(ArrayNode features) {
        return NgsiJson.object().put("type", "FeatureCollection").set("features", features);
    }

    /** @param fields a FeatureCollection */
    public static List<String> lines(JsonNode fields) {
        return TABLE.lines(fields.path("features"));
    }

    /** @param fields a FeatureCollection */
    public static List<String> names(JsonNode fields) {
        return TABLE.names(fields.path("features"));
    }
}
