package io.furrow.model.ngsi;

import java.io.IOException;
import java.nio.charset.StandardCharsets;
import java.util.ArrayList;
import java.util.List;

import com.fasterxml.jackson.core.JsonParser;
import com.fasterxml.jackson.core.JsonToken;
import com.fasterxml.jackson.core.StreamReadFeature;
import com.fasterxml.jackson.databind.JsonNode;
import com.fasterxml.jackson.databind.ObjectReader;
import com.fasterxml.jackson.databind.node.ObjectNode;

/**
 * An entity whose attributes are slices of its JSON, for readers that emit them without building a tree.
 *
 * @param type {@code Thing} if none was reported
 */
public record SlicedEntity(String type, List<Slice> attributes) {
    private static final ObjectReader READER =
            NgsiJson.mapper().reader().without(StreamReadFeature.STRICT_DUPLICATE_DETECTION);
    private static final int TYPICAL_ATTRIBUTES = 12;

    /**
     * An attribute.
     *
     * @param json normalized; the reported text if that was normalized
     * @param type as reported, or the context broker's default
     * @param unit metadata {@code unitCode}, else {@code unit}; empty if there is none
     * @param value its first token: the start of a container, or the value
     * @param number the value as a double, possibly infinite; NaN if it is not a number
     */
    public record Slice(String name, String json, String type, String unit, JsonToken value, double number) {
        /** Returns the value as a tree. */
        public JsonNode tree() throws UnreadableException {
            return NgsiJson.read(json.getBytes(StandardCharsets.UTF_8)).path("value");
        }
    }

    /**
     * Reads the UTF-8 JSON of a normalized entity.
     *
     * @throws UnreadableException as {@link Entity#parse(byte[])}
     */
    public static SlicedEntity parse(byte[] normalized) throws UnreadableException {
        Entity.parse(normalized);
        return ofChecked(normalized);
    }

    /**
     * Reads an entity that was validated before, without repeating the checks.
     *
     * @param normalized accepted by {@link Entity#parse} with any attributes
     */
    public static SlicedEntity ofChecked(byte[] normalized) throws UnreadableException {
        return NgsiJson.understand(() -> {
            try (JsonParser parser = READER.createParser(normalized)) {
                return read(parser, normalized);
            }
        });
    }

    private static SlicedEntity read(JsonParser parser, byte[] bytes) throws IOException, UnreadableException {
        String type = "Thing";
        List<Slice> attributes = new ArrayList<>(TYPICAL_ATTRIBUTES);
        parser.nextToken();
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            if (parser.nextToken() == JsonToken.START_OBJECT) {
                attributes.add(slice(name, parser, bytes));
            } else if (name.equals("type")) {
                type = parser.getText();
            }
        }
        return new SlicedEntity(type, attributes);
    }

    private static Slice slice(String name, JsonParser parser, byte[] bytes) throws IOException, UnreadableException {
        int from = (int) parser.currentTokenLocation().getByteOffset();
        String type = null;
        String[] units = new String[2];
        JsonToken value = null;
        double number = Double.NaN;
        boolean described = false;
        int members = 0;
        for (; parser.nextToken() == JsonToken.FIELD_NAME; members++) {
            String member = parser.currentName();
            JsonToken token = parser.nextToken();
            if (member.equals("value")) {
                value = token;
                number = token.isNumeric() ? parser.getDoubleValue() : number;
                parser.skipChildren();
            } else if (member.equals("type") && token == JsonToken.VALUE_STRING) {
                type = parser.getText();
            } else if (member.equals("metadata") && token == JsonToken.START_OBJECT) {
                described = true;
                readUnits(parser, units);
            } else {
                parser.skipChildren();
            }
        }
        int to = (int) parser.currentLocation().getByteOffset();
        String json = new String(bytes, from, to - from, StandardCharsets.UTF_8);
        if (type == null || !described || members != 3) {
            ObjectNode attribute = NgsiV2Representation.NORMALIZED.attribute(
                    name, NgsiJson.read(json.getBytes(StandardCharsets.UTF_8)));
            type = attribute.path("type").textValue();
            json = new String(NgsiJson.write(attribute), StandardCharsets.UTF_8);
        }
        return new Slice(
                name, json, type, units[0] == null ? units[1] == null ? "" : units[1] : units[0], value, number);
    }

    /** @param units receives the text of {@code unitCode} and the value of {@code unit} */
    private static void readUnits(JsonParser parser, String[] units) throws IOException {
        while (parser.nextToken() == JsonToken.FIELD_NAME) {
            String name = parser.currentName();
            int which = name.equals("unitCode") ? 0 : name.equals("unit") ? 1 : -1;
            if (parser.nextToken() != JsonToken.START_OBJECT || which < 0) {
                parser.skipChildren();
                continue;
            }
            while (parser.nextToken() == JsonToken.FIELD_NAME) {
                boolean isValue = parser.currentName().equals("value");
                JsonToken token = parser.nextToken();
                boolean isUsable = token == JsonToken.VALUE_STRING
                        || which == 1 && token.isScalarValue() && token != JsonToken.VALUE_NULL;
                if (isValue && isUsable) {
                    units[which] = parser.getText();
                }
                parser.skipChildren();
            }
        }
    }
}
